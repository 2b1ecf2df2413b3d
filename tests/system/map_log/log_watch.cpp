#include "system/map_log/log_watch.hpp"

#include <nav_msgs/msg/Odometry.h>
#include <rosgraph_msgs/msg/Clock.h>
#include <sensor_msgs/msg/LaserScan.h>

#include "conversions/time.hpp"

namespace coop::test {
namespace {

runtime::Options options() {
  runtime::Options options;
  options.name = "log_watch";
  return options;
}

}  // namespace

LogWatch::LogWatch(int domain)
    : transport_({.domain = domain,
                  .participant_name = "log_watch",
                  .partition = {},
                  .reliable_streams = true}),
      executor_(clock_),
      node_(options(), transport_, clock_, executor_) {
  const auto note = [this](std::set<Time>& stamps, const auto& header) {
    if (!stamps.insert(*conversions::from_msg(header.stamp())).second) ++repeats_;
  };
  node_.subscribe<nav_msgs::msg::Odometry>(
      "odom", runtime::Qos::kSensorStream,
      [=, this](const nav_msgs::msg::Odometry& odom) { note(odometry_, odom.header()); });
  node_.subscribe<sensor_msgs::msg::LaserScan>(
      "scan", runtime::Qos::kSensorStream,
      [=, this](const sensor_msgs::msg::LaserScan& scan) { note(scans_, scan.header()); });
  node_.subscribe<rosgraph_msgs::msg::Clock>("clock", runtime::Qos::kEvent,
                                             [this](const rosgraph_msgs::msg::Clock& message) {
                                               const Time time = *conversions::from_msg(message);
                                               if (time < clock_time_) ++clock_set_back_;
                                               clock_time_ = time;
                                             });
}

}  // namespace coop::test
