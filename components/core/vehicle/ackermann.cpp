#include "core/vehicle/ackermann.hpp"

#include <algorithm>
#include <cmath>

#include "core/arc.hpp"

namespace coop::vehicle {

double curvature_of(const AckermannGeometry& base, double steering) {
  return std::tan(steering) / base.wheelbase;
}

double steering_of_curvature(const AckermannGeometry& base, double curvature) {
  return std::atan(curvature * base.wheelbase);
}

Twist2 twist_of(const AckermannGeometry& base, double speed, double steering) {
  return {speed, speed * curvature_of(base, steering)};
}

double steering_of(const AckermannGeometry& base, const Twist2& twist, double at_rest) {
  constexpr double kStandstill = 1e-6;
  if (std::abs(twist.v) < kStandstill) return at_rest;
  return std::clamp(steering_of_curvature(base, twist.omega / twist.v), -base.max_steering_angle,
                    base.max_steering_angle);
}

FrontWheelAngles front_wheel_angles(const AckermannGeometry& base, double steering) {
  // Both wheels stand square to the line to the turning centre, which lies on the rear axle's line.
  const double k = curvature_of(base, steering);
  const double forward = base.wheelbase * k;
  return {std::atan2(forward, 1.0 - 0.5 * base.track * k),
          std::atan2(forward, 1.0 + 0.5 * base.track * k)};
}

WheelSpeeds wheel_speeds(const AckermannGeometry& base, double speed, double steering) {
  const double k = curvature_of(base, steering);
  const double left = 1.0 - 0.5 * base.track * k;
  const double right = 1.0 + 0.5 * base.track * k;
  const double forward = base.wheelbase * k;
  return {speed * left, speed * right, speed * std::hypot(left, forward),
          speed * std::hypot(right, forward)};
}

Pose2 advance_along_arc(const Pose2& start, double distance, double turn) {
  // The chord of an arc is distance * sin(turn/2) / (turn/2), along the mean heading: no division
  // by a small turn.
  const double half = 0.5 * turn;
  const double shrink = chord_over_arc(half);
  const double heading = start.yaw + half;
  return {start.x + distance * shrink * std::cos(heading),
          start.y + distance * shrink * std::sin(heading), normalize_angle(start.yaw + turn)};
}

void DriveLimits::describe(config::Fields& fields) {
  fields.number("max_speed_forward", max_speed_forward,
                {.unit = "m/s", .help = "fastest forward", .min = 0.01, .max = 5});
  fields.number(
      "max_speed_reverse", max_speed_reverse,
      {.unit = "m/s", .help = "fastest backward, 0 forbids reversing", .min = 0, .max = 5});
  fields.number("max_acceleration", max_acceleration,
                {.unit = "m/s^2", .help = "away from standstill", .min = 0.01, .max = 10});
  fields.number("max_deceleration", max_deceleration,
                {.unit = "m/s^2", .help = "towards standstill", .min = 0.01, .max = 10});
  fields.number("emergency_deceleration", emergency_deceleration,
                {.unit = "m/s^2",
                 .help = "when commands stop coming or an emergency stop is engaged",
                 .min = 0.01,
                 .max = 20});
}

}  // namespace coop::vehicle
