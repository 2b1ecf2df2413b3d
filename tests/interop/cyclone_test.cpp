// Another maker's DDS with nothing but ROS 2's message definitions on the one side, Coop's runtime
// on the other: every value arrives, both ways.
#include <geometry_msgs/msg/PoseStamped.h>
#include <geometry_msgs/msg/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/msg/OccupancyGrid.h>
#include <nav_msgs/msg/Odometry.h>
#include <nav_msgs/msg/Path.h>
#include <sensor_msgs/msg/LaserScan.h>
#include <tf2_msgs/msg/TFMessage.h>

#include <chrono>
#include <limits>
#include <map>
#include <thread>

#include "capture/schema/definitions.hpp"
#include "core/atomic_file.hpp"
#include "core/child_process.hpp"
#include "interop/value_lines.hpp"
#include "support/temporary_folder.hpp"
#include "system/support/listener.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

using runtime::Qos;
using Lines = std::vector<std::string>;
using std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::seconds(40);

template <class Message>
Lines lines_of(const std::string& topic, const std::string& type, const Message& message) {
  std::vector<std::uint8_t> bytes;
  runtime::message_type<Message>().serialize(&message, bytes);
  ValueLines lines(topic);
  const capture::MessageLayout layout(type, *capture::ros2msg_definition(type));
  const auto read = capture::walk(layout, std::as_bytes(std::span(bytes)), lines);
  EXPECT_TRUE(read) << type;
  return std::move(lines).lines();
}

std_msgs::msg::Header header(std::int32_t sec, const std::string& frame) {
  std_msgs::msg::Header result;
  result.stamp().sec(sec);
  result.stamp().nanosec(999'999'999);
  result.frame_id(frame);
  return result;
}

geometry_msgs::msg::Pose pose(double x) {
  geometry_msgs::msg::Pose result;
  result.position().x(x);
  result.position().y(-x / 3.0);
  result.position().z(1e-300);
  result.orientation().z(0.6);
  result.orientation().w(0.8);
  return result;
}

sensor_msgs::msg::LaserScan scan() {
  sensor_msgs::msg::LaserScan result;
  result.header(header(1'700'000'000, "laser_link"));
  result.angle_min(-3.1F);
  result.angle_max(3.1F);
  result.angle_increment(0.1F);
  result.scan_time(0.1F);
  result.range_min(0.05F);
  result.range_max(12.0F);
  const float infinity = std::numeric_limits<float>::infinity();
  result.ranges({0.1F, infinity, std::numeric_limits<float>::quiet_NaN(), 1.0F / 3.0F});
  result.intensities({1.0F, 2.0F, 3.0F, 4.0F});
  return result;
}

nav_msgs::msg::Odometry odometry() {
  nav_msgs::msg::Odometry result;
  result.header(header(-1, "odom"));
  result.child_frame_id("base_link");
  result.pose().pose(pose(12.5));
  result.twist().twist().linear().x(0.6);
  result.twist().twist().angular().z(-0.25);
  for (std::size_t i = 0; i < 36; ++i) {
    result.pose().covariance()[i] = static_cast<double>(i) / 7.0;
    result.twist().covariance()[i] = -static_cast<double>(i);
  }
  return result;
}

tf2_msgs::msg::TFMessage transforms() {
  tf2_msgs::msg::TFMessage result;
  for (int i = 0; i < 3; ++i) {
    auto& transform = result.transforms().emplace_back();
    transform.header(header(i, "map"));
    transform.child_frame_id("frame_" + std::to_string(i));
    transform.transform().translation().x(i / 3.0);
    transform.transform().rotation().w(1.0);
  }
  return result;
}

nav_msgs::msg::OccupancyGrid grid() {
  nav_msgs::msg::OccupancyGrid result;
  result.header(header(5, "map"));
  result.info().resolution(0.05F);
  result.info().width(7);
  result.info().height(3);
  result.info().origin(pose(-4.0));
  for (int i = 0; i < 21; ++i) result.data().push_back(static_cast<std::uint8_t>(i == 3 ? 255 : i));
  return result;
}

nav_msgs::msg::Path path() {
  nav_msgs::msg::Path result;
  result.header(header(6, "map"));
  for (int i = 0; i < 5; ++i) {
    auto& stamped = result.poses().emplace_back();
    stamped.header(header(6 + i, i % 2 == 0 ? "map" : ""));
    stamped.pose(pose(i * 0.1));
  }
  return result;
}

/// What the peer has printed, by topic: the values of the first message of each.
std::map<std::string, Lines> printed(const std::filesystem::path& file) {
  std::map<std::string, Lines> begun;
  std::map<std::string, Lines> result;
  std::istringstream in(read_file(file));
  for (std::string line; std::getline(in, line);) {
    const std::string topic = line.substr(0, line.find(' '));
    if (line == topic + " .") {
      result.emplace(topic, std::exchange(begun[topic], {}));
    } else {
      begun[topic].push_back(line);
    }
  }
  return result;
}

class CyclonePeer : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(COOP_CYCLONE_PEER).empty()) {
      GTEST_SKIP() << "not run: Cyclone DDS (cyclonedds-dev, cyclonedds-tools) is not installed";
    }
  }

  /// Publishes until the peer has printed a message of each of the topics and ours have arrived.
  template <class Publish>
  std::map<std::string, Lines> exchange(Listener& coop, const Publish& publish,
                                        const std::function<bool()>& has_arrived) {
    const auto output = folder_.path() / "peer.txt";
    ChildProcess peer({COOP_CYCLONE_PEER, std::to_string(test_domain())}, output);
    const auto end = steady_clock::now() + kPatience;
    auto next = steady_clock::now();
    while (steady_clock::now() < end) {
      if (steady_clock::now() >= next) {
        publish();
        next += std::chrono::milliseconds(100);
      }
      coop.look();
      const auto lines = printed(output);
      if (lines.size() == 7 && has_arrived()) return lines;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return printed(output);
  }

  TemporaryFolder folder_;
};

TEST_F(CyclonePeer, reads_and_writes_every_value_as_coop_does) {
  Listener coop(test_domain(), "interop");
  auto& node = coop.node();
  auto scans = node.advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream);
  auto odometries = node.advertise<nav_msgs::msg::Odometry>("odom", Qos::kSensorStream);
  auto tfs = node.advertise<tf2_msgs::msg::TFMessage>("tf", Qos::kEvent);
  auto maps = node.advertise<nav_msgs::msg::OccupancyGrid>("map", Qos::kStateLatched);
  auto plans = node.advertise<nav_msgs::msg::Path>("plan", Qos::kStateLatched);
  std::map<std::string, Lines> arrived;
  node.subscribe<geometry_msgs::msg::PoseStamped>("goal_pose", Qos::kEvent, [&](const auto& goal) {
    arrived["goal_pose"] = lines_of("goal_pose", "geometry_msgs/PoseStamped", goal);
  });
  node.subscribe<geometry_msgs::msg::TwistStamped>(
      "cmd_vel", Qos::kCommand, [&](const auto& twist) {
        arrived["cmd_vel"] = lines_of("cmd_vel", "geometry_msgs/TwistStamped", twist);
      });
  // Latched: one is enough, even before anybody listens.
  maps.publish(grid());
  plans.publish(path());

  const auto lines = exchange(
      coop,
      [&] {
        scans.publish(scan());
        odometries.publish(odometry());
        tfs.publish(transforms());
      },
      [&] { return arrived.size() == 2; });

  EXPECT_EQ(lines.size(), 7U);
  const auto of_peer = [&](const std::string& topic) {
    const auto found = lines.find(topic);
    return found == lines.end() ? Lines{"nothing of " + topic} : found->second;
  };
  EXPECT_EQ(of_peer("scan"), lines_of("scan", "sensor_msgs/LaserScan", scan()));
  EXPECT_EQ(of_peer("odom"), lines_of("odom", "nav_msgs/Odometry", odometry()));
  EXPECT_EQ(of_peer("tf"), lines_of("tf", "tf2_msgs/TFMessage", transforms()));
  EXPECT_EQ(of_peer("map"), lines_of("map", "nav_msgs/OccupancyGrid", grid()));
  EXPECT_EQ(of_peer("plan"), lines_of("plan", "nav_msgs/Path", path()));
  EXPECT_EQ(arrived["goal_pose"], of_peer("goal_pose"));
  EXPECT_EQ(arrived["cmd_vel"], of_peer("cmd_vel"));
  EXPECT_EQ(arrived["cmd_vel"].size(), 9U);
}

}  // namespace
}  // namespace coop::test
