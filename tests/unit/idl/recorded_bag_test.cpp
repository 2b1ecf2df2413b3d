// Samples that real ROS 2 nodes wrote: read with our types and written again, they give the same
// bytes.
#include "unit/idl/recorded_bag.hpp"

#include <gtest/gtest.h>

#include "nav_msgs/msg/OdometryPubSubTypes.h"
#include "sensor_msgs/msg/LaserScanPubSubTypes.h"
#include "std_msgs/msg/StringPubSubTypes.h"
#include "tf2_msgs/msg/TFMessagePubSubTypes.h"
#include "unit/idl/topic_type.hpp"

namespace coop::test {
namespace {

class RecordedBag : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = recorded_bag();
    if (!file) GTEST_SKIP() << "not run: the recorded bag is not at hand";
    bag_ = *file;
  }

  void expect_same_after_round_trip(TopicDataType& type, const std::string& name,
                                    std::size_t count) {
    const auto samples = samples_of(bag_, name);
    EXPECT_EQ(samples.size(), count);
    for (const Bytes& bytes : samples) {
      const auto sample = decode(type, bytes);
      ASSERT_TRUE(sample);
      ASSERT_EQ(encode(type, sample), bytes);
    }
  }

  std::filesystem::path bag_;
};

TEST_F(RecordedBag, laser_scans_are_read_and_written_to_the_byte) {
  sensor_msgs::msg::LaserScanPubSubType type;
  expect_same_after_round_trip(type, "sensor_msgs/msg/LaserScan", 357);
}

TEST_F(RecordedBag, odometry_is_read_and_written_to_the_byte) {
  nav_msgs::msg::OdometryPubSubType type;
  expect_same_after_round_trip(type, "nav_msgs/msg/Odometry", 920);
}

TEST_F(RecordedBag, transforms_are_read_and_written_to_the_byte) {
  tf2_msgs::msg::TFMessagePubSubType type;
  expect_same_after_round_trip(type, "tf2_msgs/msg/TFMessage", 953 + 2);
}

TEST_F(RecordedBag, the_robot_description_is_read_and_written_to_the_byte) {
  std_msgs::msg::StringPubSubType type;
  expect_same_after_round_trip(type, "std_msgs/msg/String", 1);
}

TEST_F(RecordedBag, decoded_values_are_those_of_a_robot_in_a_building) {
  sensor_msgs::msg::LaserScanPubSubType type;
  const auto samples = samples_of(bag_, "sensor_msgs/msg/LaserScan");
  ASSERT_FALSE(samples.empty());
  const auto sample = decode(type, samples.front());
  ASSERT_TRUE(sample);
  const auto& scan = *static_cast<const sensor_msgs::msg::LaserScan*>(sample.get());
  EXPECT_EQ(scan.ranges().size(), scan.intensities().size());
  EXPECT_NEAR(
      static_cast<double>(scan.angle_max() - scan.angle_min()),
      static_cast<double>(scan.angle_increment()) * static_cast<double>(scan.ranges().size() - 1),
      0.05);
  EXPECT_GT(scan.header().stamp().sec(), 1'600'000'000);
}

}  // namespace
}  // namespace coop::test
