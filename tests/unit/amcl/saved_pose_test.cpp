#include "amcl/saved_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coop::amcl {
namespace {

SavedPose example() {
  SavedPose saved;
  saved.stamp = Time(Duration(1234567890123456789));
  saved.map_hash = 0xFFFFFFFFFFFFFFF0ULL;
  saved.robot_in_map.pose = {1.25, -3.0, 0.1};
  saved.robot_in_map.covariance << 0.04, 0.01, 0.001, 0.01, 0.09, 0.002, 0.001, 0.002, 0.01;
  saved.base_in_odom = {10, 20, std::numbers::pi / 2};
  return saved;
}

TEST(SavedPose, ComesBackToTheBit) {
  const auto back = parse_saved_pose(to_text(example()));
  ASSERT_TRUE(back.has_value()) << back.error();
  EXPECT_EQ(back->stamp, example().stamp);
  EXPECT_EQ(back->map_hash, example().map_hash);
  EXPECT_EQ(back->robot_in_map.pose, example().robot_in_map.pose);
  EXPECT_EQ(back->robot_in_map.covariance, example().robot_in_map.covariance);
  EXPECT_EQ(back->base_in_odom, example().base_in_odom);
}

TEST(SavedPose, RefusesEveryTruncatedText) {
  const std::string text = to_text(example());
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    EXPECT_FALSE(parse_saved_pose(text.substr(0, length)).has_value()) << length;
  }
}

TEST(SavedPose, RefusesOtherFormatsAndImpossibleNumbers) {
  EXPECT_FALSE(parse_saved_pose("{}").has_value());
  EXPECT_FALSE(parse_saved_pose("[1, 2]").has_value());
  EXPECT_FALSE(parse_saved_pose(R"({"format": "something else"})").has_value());
  SavedPose bad = example();
  bad.robot_in_map.covariance(1, 1) = -1.0;
  EXPECT_FALSE(parse_saved_pose(to_text(bad)).has_value());
  bad = example();
  bad.robot_in_map.pose.x = std::nan("");
  EXPECT_FALSE(parse_saved_pose(to_text(bad)).has_value());
}

TEST(Resume, AddsTheMotionWhenTheOdometryRanOn) {
  // The odometry looks along its y axis; it saw 1 m forward in 3 s.
  const PoseEstimate now =
      resume(example(), example().stamp + seconds(3.0), {10, 21, std::numbers::pi / 2});
  const Pose2 expected = Pose2{1.25, -3.0, 0.1} * Pose2{1, 0, 0};
  EXPECT_NEAR(distance(now.pose, expected), 0.0, 1e-9);
  EXPECT_NEAR(now.covariance(0, 0), 0.04 + 0.15 * 0.15, 1e-12);
}

TEST(Resume, KeepsThePoseWhenTheOdometryWasRestarted) {
  const PoseEstimate now = resume(example(), example().stamp + seconds(3.0), {0, 0, 0});
  EXPECT_EQ(now.pose, example().robot_in_map.pose);
  EXPECT_NEAR(now.covariance(0, 0), 0.04 + 0.05 * 0.05, 1e-12);
}

TEST(Resume, KeepsThePoseAfterALongTimeOrWhenTheClockWasSetBack) {
  for (const double gap : {3600.0, -5.0}) {
    const PoseEstimate now =
        resume(example(), example().stamp + seconds(gap), {10, 20.5, std::numbers::pi / 2});
    EXPECT_EQ(now.pose, example().robot_in_map.pose);
  }
}

TEST(MapHash, TellsMapsApart) {
  const OccupancyGrid map({10, 10, 0.05, {0, 0}}, kFree);
  OccupancyGrid other = map;
  EXPECT_EQ(hash_of(map), hash_of(other));
  other[{3, 3}] = kOccupied;
  EXPECT_NE(hash_of(map), hash_of(other));
  other = map;
  other.geometry.origin.x() = 0.01;
  EXPECT_NE(hash_of(map), hash_of(other));
}

}  // namespace
}  // namespace coop::amcl
