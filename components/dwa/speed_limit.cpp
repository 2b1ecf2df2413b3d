#include "dwa/speed_limit.hpp"

#include <algorithm>
#include <cmath>

namespace coop::dwa {

double braking_speed(const SpeedConfig& config, double distance) {
  return std::max(config.creep_speed, std::sqrt(2.0 * config.braking * std::max(0.0, distance)));
}

double bend_speed(const SpeedConfig& config, double curvature) {
  const double amount = std::abs(curvature);
  const double fastest = config.max_vel_x;
  if (amount * fastest * fastest <= config.max_lateral_acceleration) return fastest;
  return std::sqrt(config.max_lateral_acceleration / amount);
}

double narrow_speed(const SpeedConfig& config, double clearance) {
  const double part = std::clamp(clearance / config.narrow_clearance, 0.0, 1.0);
  return config.narrow_speed + part * std::max(0.0, config.max_vel_x - config.narrow_speed);
}

double steering_speed(const SpeedConfig& config, double turn, double distance,
                      double steering_rate) {
  const double amount = std::abs(turn);
  if (amount * config.max_vel_x <= steering_rate * distance) return config.max_vel_x;
  return std::max(config.creep_speed, steering_rate * distance / amount);
}

}  // namespace coop::dwa
