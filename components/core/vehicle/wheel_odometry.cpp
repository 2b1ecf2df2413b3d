#include "core/vehicle/wheel_odometry.hpp"

#include <cmath>

namespace coop::vehicle {

void OdometryNoise::describe(config::Fields& fields) {
  fields.number(
      "translation_per_metre", translation_per_metre,
      {.unit = "m/sqrt(m)", .help = "growth of the position's deviation", .min = 0, .max = 1});
  fields.number("rotation_per_radian", rotation_per_radian,
                {.unit = "rad/sqrt(rad)",
                 .help = "growth of the yaw's deviation with turns",
                 .min = 0,
                 .max = 1});
  fields.number("rotation_per_metre", rotation_per_metre,
                {.unit = "rad/sqrt(m)",
                 .help = "growth of the yaw's deviation with distance",
                 .min = 0,
                 .max = 1});
}

OdometryIntegrator::OdometryIntegrator(const OdometryNoise& noise, const Pose2& start)
    : noise_(noise) {
  odometry_.base_in_odom = start;
}

void OdometryIntegrator::advance(double distance, double turn, Time stamp) {
  const Pose2 before = odometry_.base_in_odom;
  const Pose2 after = advance_along_arc(before, distance, turn);

  // x' = x + d cos(yaw + turn/2), y' likewise: derivatives by the pose and by (d, turn).
  const double heading = before.yaw + 0.5 * turn;
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Identity();
  by_pose(0, 2) = -(after.y - before.y);
  by_pose(1, 2) = after.x - before.x;
  Eigen::Matrix<double, 3, 2> by_motion;
  by_motion << std::cos(heading), -0.5 * (after.y - before.y),  //
      std::sin(heading), 0.5 * (after.x - before.x),            //
      0.0, 1.0;
  const double length = std::abs(distance);
  const Eigen::Vector2d variance(
      noise_.translation_per_metre * noise_.translation_per_metre * length,
      noise_.rotation_per_radian * noise_.rotation_per_radian * std::abs(turn) +
          noise_.rotation_per_metre * noise_.rotation_per_metre * length);
  covariance_ = by_pose * covariance_ * by_pose.transpose() +
                by_motion * variance.asDiagonal() * by_motion.transpose();

  const double span = odometry_.stamp == Time{} ? 0.0 : to_seconds(stamp - odometry_.stamp);
  odometry_.velocity = span > 0.0 ? Twist2{distance / span, turn / span} : Twist2{};
  odometry_.base_in_odom = after;
  odometry_.stamp = stamp;
}

void WheelOdometryConfig::describe(config::Fields& fields) {
  fields.number("metres_per_tick", metres_per_tick,
                {.unit = "m",
                 .help = "travel of a rear wheel a tick of its encoder",
                 .min = 1e-6,
                 .max = 0.1});
  fields.section("noise", noise);
}

WheelOdometry::WheelOdometry(const WheelOdometryConfig& config, const AckermannGeometry& base,
                             const Pose2& start)
    : config_(config), base_(base), integrator_(config.noise, start) {}

const Odometry& WheelOdometry::update(const WheelReading& reading) {
  if (!has_last_) {
    last_ = reading;
    has_last_ = true;
  }
  const auto ticks = (reading.rear_left_ticks - last_.rear_left_ticks) +
                     (reading.rear_right_ticks - last_.rear_right_ticks);
  const double distance = 0.5 * static_cast<double>(ticks) * config_.metres_per_tick;
  const double steering = 0.5 * (reading.steering + last_.steering);
  integrator_.advance(distance, distance * curvature_of(base_, steering), reading.stamp);
  last_ = reading;
  return integrator_.odometry();
}

}  // namespace coop::vehicle
