#pragma once
#include <sensor_msgs/msg/LaserScan.h>

#include <utility>

#include "conversions/sensors.hpp"
#include "runtime/stamped_queue.hpp"

namespace coop::runtime {

/// Callback of a subscription to scans: puts each into `queue`, to wait for the robot's pose at its
/// first beam. Scans that make no sense are left out. The queue must outlive the subscription.
[[nodiscard]] inline auto put_into(StampedQueue<LaserScan>& queue) {
  return [&queue](const sensor_msgs::msg::LaserScan& message) {
    auto scan = conversions::from_msg(message);
    if (!scan) return;
    const Time stamp = scan->stamp;
    queue.push(std::move(*scan), "base_link", stamp);
  };
}

}  // namespace coop::runtime
