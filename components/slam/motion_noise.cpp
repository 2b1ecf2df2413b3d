#include "slam/motion_noise.hpp"

#include <cmath>

namespace coop::slam {

void MotionNoiseConfig::describe(config::Fields& fields) {
  fields.number("position_per_distance", position_per_distance,
                {.unit = "m/sqrt(m)",
                 .help = "odometry's error of position by distance",
                 .min = 0.0,
                 .max = 1.0});
  fields.number("position_per_turn", position_per_turn,
                {.unit = "m/sqrt(rad)",
                 .help = "odometry's error of position by turning",
                 .min = 0.0,
                 .max = 1.0});
  fields.number("yaw_per_distance", yaw_per_distance,
                {.unit = "rad/sqrt(m)",
                 .help = "odometry's error of yaw by distance",
                 .min = 0.0,
                 .max = 1.0});
  fields.number("yaw_per_turn", yaw_per_turn,
                {.unit = "rad/sqrt(rad)",
                 .help = "odometry's error of yaw by turning",
                 .min = 0.0,
                 .max = 1.0});
  fields.number(
      "min_position", min_position,
      {.unit = "m", .help = "error of position even without motion", .min = 1e-4, .max = 1.0});
  fields.number(
      "min_yaw", min_yaw,
      {.unit = "rad", .help = "error of yaw even without motion", .min = 1e-4, .max = 1.0});
  fields.number("restart_position", restart_position,
                {.unit = "m",
                 .help = "error of position where odometry was restarted",
                 .min = 1e-3,
                 .max = 5.0});
  fields.number("restart_yaw", restart_yaw,
                {.unit = "rad",
                 .help = "error of yaw where odometry was restarted",
                 .min = 1e-3,
                 .max = 3.2});
}

Eigen::Vector3d motion_stddev(const MotionNoiseConfig& config, const Pose2& motion,
                              bool restarted) {
  const double distance = std::hypot(motion.x, motion.y);
  const double turn = std::abs(motion.yaw);
  const auto variance = [&](double by_distance, double by_turn, double least) {
    return by_distance * by_distance * distance + by_turn * by_turn * turn + least * least;
  };
  const double position = std::sqrt(
      variance(config.position_per_distance, config.position_per_turn, config.min_position));
  const double yaw =
      std::sqrt(variance(config.yaw_per_distance, config.yaw_per_turn, config.min_yaw));
  if (!restarted) return {position, position, yaw};
  const double wide = std::hypot(position, config.restart_position);
  return {wide, wide, std::hypot(yaw, config.restart_yaw)};
}

}  // namespace coop::slam
