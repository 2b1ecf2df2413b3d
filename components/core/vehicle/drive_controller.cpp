#include "core/vehicle/drive_controller.hpp"

#include <algorithm>
#include <cmath>

namespace coop::vehicle {
namespace {

double approach(double from, double to, double step) {
  return from + std::clamp(to - from, -step, step);
}

/// Speed after `dt` seconds: slows down by at most `deceleration`, and only from standstill speeds
/// up again.
double ramp_speed(double speed, double target, double acceleration, double deceleration,
                  double dt) {
  const bool slower = speed != 0.0 && (std::abs(target) < std::abs(speed) || target * speed < 0.0);
  if (!slower) return approach(speed, target, acceleration * dt);
  const double towards = target * speed < 0.0 ? 0.0 : target;
  return approach(speed, towards, deceleration * dt);
}

}  // namespace

void DriveConfig::describe(config::Fields& fields) {
  fields.section("limits", limits);
  fields.section("watchdog", watchdog);
}

DriveController::DriveController(const DriveConfig& config, const AckermannGeometry& base)
    : limits_(config.limits), base_(base), gate_(config.watchdog) {}

DriveSetpoint DriveController::step(Time now, Duration dt) {
  const CommandGate::Decision decision = gate_.decide(now);
  const double span = to_seconds(dt);
  const double steering = steering_of(base_, decision.command, setpoint_.steering);
  const double speed =
      std::clamp(decision.command.v, -limits_.max_speed_reverse, limits_.max_speed_forward);
  const double deceleration = decision.cause == DriveCause::kCommand
                                  ? limits_.max_deceleration
                                  : limits_.emergency_deceleration;
  setpoint_.speed =
      ramp_speed(setpoint_.speed, speed, limits_.max_acceleration, deceleration, span);
  setpoint_.steering = approach(setpoint_.steering, steering, base_.max_steering_rate * span);
  setpoint_.cause = decision.cause;
  return setpoint_;
}

}  // namespace coop::vehicle
