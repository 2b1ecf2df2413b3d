#pragma once
#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/robot/robot_model.hpp"

/// Car-like kinematics: two rear wheels on a fixed axle with base_link in its middle, two front
/// wheels that steer. "Steering angle" is that of the virtual middle front wheel of the bicycle
/// model, counter-clockwise positive.
namespace coop::vehicle {

using robot::AckermannGeometry;

/// Speeds at which the wheels' contact points move along their rolling directions, m/s.
struct WheelSpeeds {
  double rear_left = 0.0;
  double rear_right = 0.0;
  double front_left = 0.0;
  double front_right = 0.0;
};

/// Angles of the two front wheels about the vertical, rad.
struct FrontWheelAngles {
  double left = 0.0;
  double right = 0.0;
};

/// Turn a metre travelled, 1/m, positive to the left.
[[nodiscard]] double curvature_of(const AckermannGeometry& base, double steering);
[[nodiscard]] double steering_of_curvature(const AckermannGeometry& base, double curvature);

[[nodiscard]] Twist2 twist_of(const AckermannGeometry& base, double speed, double steering);
/// Steering angle for the twist, within the limits; `at_rest` where the twist stands still, for
/// then no angle follows from it.
[[nodiscard]] double steering_of(const AckermannGeometry& base, const Twist2& twist,
                                 double at_rest);

[[nodiscard]] FrontWheelAngles front_wheel_angles(const AckermannGeometry& base, double steering);
[[nodiscard]] WheelSpeeds wheel_speeds(const AckermannGeometry& base, double speed,
                                       double steering);

/// The pose after `distance` metres and a turn of `turn` radians, both at constant rate: an exact
/// circular arc.
[[nodiscard]] Pose2 advance_along_arc(const Pose2& start, double distance, double turn);

/// What the drive may do beside what its geometry says. All positive.
struct DriveLimits {
  double max_speed_forward = 0.6;  ///< m/s
  double max_speed_reverse = 0.3;  ///< m/s
  double max_acceleration = 0.5;   ///< m/s^2, away from standstill
  double max_deceleration = 0.8;   ///< m/s^2, towards standstill: more than planners count on
  double emergency_deceleration =
      1.5;  ///< m/s^2, when stopping for want of commands or by emergency stop

  void describe(config::Fields& fields);
};

}  // namespace coop::vehicle
