#include "sequencer/approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coop::sequencer {

void ApproachConfig::describe(config::Fields& fields) {
  fields.number("distance", distance,
                {.unit = "m", .help = "from base_link to the egg", .min = 0.1, .max = 3});
  fields.integer("headings", headings,
                 {.help = "poses tried on the circle around the egg", .min = 1, .max = 360});
  fields.number(
      "beyond", beyond,
      {.unit = "m", .help = "cleaning: of the blade beyond a heap at the end", .min = 0, .max = 1});
  fields.number("reach_along", reach.along,
                {.unit = "m", .help = "tolerance along the heading", .min = 0, .max = 1});
  fields.number("reach_across", reach.across,
                {.unit = "m", .help = "tolerance across the heading", .min = 0, .max = 1});
}

namespace {

Pose2 pose_on_circle(const Eigen::Vector2d& egg, double heading, double distance) {
  return {egg.x() - distance * std::cos(heading), egg.y() - distance * std::sin(heading),
          normalize_angle(heading)};
}

}  // namespace

Pose2 approach_pose(const Eigen::Vector2d& robot, const Eigen::Vector2d& egg, double distance) {
  const Eigen::Vector2d line = egg - robot;
  return pose_on_circle(egg, std::atan2(line.y(), line.x()), distance);
}

std::optional<Pose2> choose_approach(const Pose2& robot_in_map, const Eigen::Vector2d& egg_in_map,
                                     const ApproachConfig& config, const PoseCost& cost,
                                     const std::vector<double>& avoid, double avoid_near) {
  const auto is_avoided = [&](const Pose2& pose) {
    return std::ranges::any_of(avoid, [&](double heading) {
      return std::abs(angle_difference(pose.yaw, heading)) < avoid_near;
    });
  };
  const Pose2 direct = approach_pose(robot_in_map.position(), egg_in_map, config.distance);
  if (!is_avoided(direct) && cost(direct)) return direct;
  std::optional<Pose2> best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int i = 1; i < config.headings; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / config.headings;
    const Pose2 pose = pose_on_circle(egg_in_map, direct.yaw + turn, config.distance);
    if (is_avoided(pose)) continue;
    const auto price = cost(pose);
    if (price && *price < best_cost) {
      best_cost = *price;
      best = pose;
    }
  }
  return best;
}

bool is_within_reach(const Pose2& robot_in_map, const Eigen::Vector2d& egg_in_map,
                     const ApproachConfig& config) {
  const Eigen::Vector2d egg_in_base = robot_in_map.inverse() * egg_in_map;
  return config.reach.contains(egg_in_base - Eigen::Vector2d(config.distance, 0.0));
}

}  // namespace coop::sequencer
