#include "system/map_log/log_watch.hpp"

#include <nav_msgs/msg/Odometry.h>
#include <rosgraph_msgs/msg/Clock.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "conversions/time.hpp"

namespace coop::test {
LogWatch::LogWatch(int domain) : listener_(domain, "log_watch", true) {
  const auto note = [this](std::set<Time>& stamps, const auto& header) {
    if (!stamps.insert(*conversions::from_msg(header.stamp())).second) ++repeats_;
  };
  listener_.node().subscribe<nav_msgs::msg::Odometry>(
      "odom", runtime::Qos::kSensorStream,
      [=, this](const nav_msgs::msg::Odometry& odom) { note(odometry_, odom.header()); });
  listener_.node().subscribe<sensor_msgs::msg::LaserScan>(
      "scan", runtime::Qos::kSensorStream,
      [=, this](const sensor_msgs::msg::LaserScan& scan) { note(scans_, scan.header()); });
  listener_.node().subscribe<rosgraph_msgs::msg::Clock>(
      "clock", runtime::Qos::kEvent, [this](const rosgraph_msgs::msg::Clock& message) {
        const Time time = *conversions::from_msg(message);
        if (time < clock_time_) ++clock_set_back_;
        clock_time_ = time;
      });
}

}  // namespace coop::test
