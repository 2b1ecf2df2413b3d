#pragma once
#include "dwa/config.hpp"

namespace coop::dwa {

/// What bounds the speed (amounts, m/s) besides the dynamic window.

/// Fastest speed at which the robot still stops within `distance` metres, at least the creeping
/// speed while there is anything left to drive: v = sqrt(2 a s).
[[nodiscard]] double braking_speed(const SpeedConfig& config, double distance);

/// In a bend of that curvature (1/m): v = sqrt(a_lateral / |curvature|).
[[nodiscard]] double bend_speed(const SpeedConfig& config, double curvature);

/// With `clearance` metres of free space beside the robot.
[[nodiscard]] double narrow_speed(const SpeedConfig& config, double clearance);

/// While the steering angle has to change by `turn` radians within `distance` metres: v = rate
/// distance / turn.
[[nodiscard]] double steering_speed(const SpeedConfig& config, double turn, double distance,
                                    double steering_rate);

}  // namespace coop::dwa
