#pragma once
#include <nav_msgs/msg/Odometry.h>

#include "core/odometry.hpp"
#include "runtime/node.hpp"

namespace coop::chassis_driver {

/// odom and tf odom -> base_link, both from one reading.
class OdometryOutput {
 public:
  explicit OdometryOutput(runtime::Node& node);

  /// False when a reliable reader is too slow; nothing was published then.
  bool publish(const Odometry& odometry, const Eigen::Matrix3d& covariance);
  [[nodiscard]] int subscribers() const { return odom_.subscribers(); }
  bool wait_for_acknowledgments(Duration timeout) {
    return odom_.wait_for_acknowledgments(timeout);
  }

 private:
  runtime::Node& node_;
  runtime::Publisher<nav_msgs::msg::Odometry> odom_;
};

}  // namespace coop::chassis_driver
