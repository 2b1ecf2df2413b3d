#include "capture/traffic/offered_qos.hpp"

#include <gtest/gtest.h>

namespace coop::capture {
namespace {

TEST(OfferedQosProfiles, AreReadAsTheyWereWritten) {
  OfferedQos qos;
  qos.reliable = false;
  qos.transient_local = true;
  qos.history = OfferedQos::History::kKeepLast;
  qos.depth = 5;
  qos.deadline = std::chrono::milliseconds(200);
  qos.liveliness = OfferedQos::Liveliness::kManualByTopic;
  qos.liveliness_lease = std::chrono::seconds(1);
  const auto read = parse_offered_qos(to_yaml(qos));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read.front(), qos);
  EXPECT_EQ(parse_offered_qos(to_yaml({})).front(), OfferedQos{});
}

TEST(OfferedQosProfiles, OfRosbag2AreUnderstoodInNumbersAndInWords) {
  const auto humble = parse_offered_qos(
      "- history: 3\n  depth: 0\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: "
      "2147483647\n    nsec: 4294967295\n  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  "
      "liveliness: 1\n  liveliness_lease_duration:\n    sec: 2\n    nsec: 500000000\n  "
      "avoid_ros_namespace_conventions: false");
  ASSERT_EQ(humble.size(), 1U);
  EXPECT_TRUE(humble[0].reliable);
  EXPECT_TRUE(humble[0].transient_local);
  EXPECT_EQ(humble[0].deadline, Duration::max());
  EXPECT_EQ(humble[0].lifespan, Duration::max());
  EXPECT_EQ(humble[0].liveliness_lease, std::chrono::milliseconds(2500));

  const auto jazzy = parse_offered_qos(
      "- history: keep_last\n  depth: 10\n  reliability: best_effort\n  durability: volatile\n"
      "- history: keep_all\n  depth: 0\n  reliability: reliable\n  durability: transient_local\n");
  ASSERT_EQ(jazzy.size(), 2U);
  EXPECT_FALSE(jazzy[0].reliable);
  EXPECT_EQ(jazzy[0].depth, 10);
  EXPECT_EQ(jazzy[1].history, OfferedQos::History::kKeepAll);
  EXPECT_TRUE(jazzy[1].transient_local);
}

TEST(OfferedQosProfiles, ThatAreNoneGiveNone) {
  EXPECT_TRUE(parse_offered_qos("").empty());
  EXPECT_TRUE(parse_offered_qos("what: ever\n").empty());
}

}  // namespace
}  // namespace coop::capture
