// What real ROS 2 nodes publish is taken in.
#include <gtest/gtest.h>

#include "conversions/geometry.hpp"
#include "conversions/navigation.hpp"
#include "conversions/sensors.hpp"
#include "nav_msgs/msg/OdometryPubSubTypes.h"
#include "sensor_msgs/msg/LaserScanPubSubTypes.h"
#include "tf2_msgs/msg/TFMessagePubSubTypes.h"
#include "unit/idl/recorded_bag.hpp"
#include "unit/idl/topic_type.hpp"

namespace coop::conversions {
namespace {

template <class PubSubType>
std::vector<typename PubSubType::type> recorded(const std::string& name) {
  std::vector<typename PubSubType::type> messages;
  const auto bag = test::recorded_bag();
  if (!bag) return messages;
  PubSubType type;
  for (const auto& bytes : test::samples_of(*bag, name)) {
    const auto sample = test::decode(type, bytes);
    EXPECT_TRUE(sample);
    if (sample) messages.push_back(*static_cast<typename PubSubType::type*>(sample.get()));
  }
  return messages;
}

TEST(RecordedMessages, all_laser_scans_are_taken_in) {
  const auto messages =
      recorded<sensor_msgs::msg::LaserScanPubSubType>("sensor_msgs/msg/LaserScan");
  if (messages.empty()) GTEST_SKIP() << "not run: the recorded bag is not at hand";
  std::size_t hits = 0;
  for (const auto& message : messages) {
    const auto scan = from_msg(message);
    ASSERT_TRUE(scan) << scan.error();
    for (std::size_t i = 0; i < scan->ranges.size(); ++i) hits += scan->is_hit(i) ? 1U : 0U;
  }
  EXPECT_GT(hits, messages.size() * 100) << "a robot in a building sees walls";
}

TEST(RecordedMessages, all_odometry_is_taken_in_and_moves_in_small_steps) {
  const auto messages = recorded<nav_msgs::msg::OdometryPubSubType>("nav_msgs/msg/Odometry");
  if (messages.empty()) GTEST_SKIP() << "not run: the recorded bag is not at hand";
  std::optional<Odometry> last;
  for (const auto& message : messages) {
    const auto odometry = from_msg(message);
    ASSERT_TRUE(odometry) << odometry.error();
    if (last) {
      EXPECT_LT(distance(last->base_in_odom, odometry->odometry.base_in_odom), 0.2);
    }
    last = odometry->odometry;
  }
}

TEST(RecordedMessages, all_transforms_are_taken_in) {
  const auto messages = recorded<tf2_msgs::msg::TFMessagePubSubType>("tf2_msgs/msg/TFMessage");
  if (messages.empty()) GTEST_SKIP() << "not run: the recorded bag is not at hand";
  for (const auto& message : messages) {
    const auto transforms = from_msg(message);
    ASSERT_TRUE(transforms) << transforms.error();
    EXPECT_FALSE(transforms->empty());
  }
}

}  // namespace
}  // namespace coop::conversions
