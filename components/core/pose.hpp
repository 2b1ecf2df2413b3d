#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/time.hpp"

namespace coop {

/// Angle folded into [-pi, pi).
inline double normalize_angle(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double folded = angle - kTurn * std::floor((angle + std::numbers::pi) / kTurn);
  return folded >= std::numbers::pi ? folded - kTurn : folded;
}

/// Shortest signed turn from angle `from` to angle `to`, in [-pi, pi).
inline double angle_difference(double to, double from) {
  return normalize_angle(to - from);
}

/// Planar pose, metres and radians. The name of a variable says the frame: `robot_in_map`. a_in_b *
/// c_in_a = c_in_b.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;  ///< counter-clockwise from x, radians

  [[nodiscard]] Eigen::Vector2d position() const { return {x, y}; }

  [[nodiscard]] Pose2 operator*(const Pose2& other) const {
    const double c = std::cos(yaw);
    const double s = std::sin(yaw);
    return {x + c * other.x - s * other.y, y + s * other.x + c * other.y,
            normalize_angle(yaw + other.yaw)};
  }
  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& point) const {
    const double c = std::cos(yaw);
    const double s = std::sin(yaw);
    return {x + c * point.x() - s * point.y(), y + s * point.x() + c * point.y()};
  }
  [[nodiscard]] Pose2 inverse() const {
    const double c = std::cos(yaw);
    const double s = std::sin(yaw);
    return {-c * x - s * y, s * x - c * y, normalize_angle(-yaw)};
  }
  bool operator==(const Pose2&) const = default;
};

inline double distance(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Pose between `a` (ratio 0) and `b` (ratio 1): position linear, yaw the short way round.
inline Pose2 interpolate(const Pose2& a, const Pose2& b, double ratio) {
  return {a.x + ratio * (b.x - a.x), a.y + ratio * (b.y - a.y),
          normalize_angle(a.yaw + ratio * angle_difference(b.yaw, a.yaw))};
}

inline bool is_finite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

/// Velocity in the robot's own frame (base_link).
struct Twist2 {
  double v = 0.0;      ///< forward, m/s
  double omega = 0.0;  ///< counter-clockwise, rad/s
  bool operator==(const Twist2&) const = default;
};

struct StampedPose2 {
  Time stamp{};
  Pose2 pose;
};

/// Spatial pose, metres.
using Pose3 = Eigen::Isometry3d;

inline Pose3 to_pose3(const Pose2& pose) {
  Pose3 result = Pose3::Identity();
  result.translation() << pose.x, pose.y, 0.0;
  result.linear() = Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return result;
}

/// Projection onto the floor: x, y and the heading of the x axis.
inline Pose2 to_pose2(const Pose3& pose) {
  return {pose.translation().x(), pose.translation().y(),
          std::atan2(pose.linear()(1, 0), pose.linear()(0, 0))};
}

}  // namespace coop
