#include "referee/judgement.hpp"

#include <array>
#include <cmath>

namespace coop::referee {
namespace {

/// 1 on the range's border.
double share_of_range(const Eigen::Vector2d& deviation, const robot::WorkingRange& range) {
  return std::max(std::abs(deviation.x()) / range.along, std::abs(deviation.y()) / range.across);
}

}  // namespace

Arrival analyse(const Standing& standing, const Eigen::Vector2d& working_point) {
  const Pose2 map_in_base = standing.robot_in_map.inverse();
  const Pose2 map_in_believed = standing.believed_robot_in_map.inverse();
  const Eigen::Vector2d egg_from_believed = map_in_believed * standing.egg_in_map;
  const Eigen::Vector2d believed_egg = map_in_believed * standing.believed_egg_in_map;
  Arrival arrival;
  arrival.stamp = standing.stamp;
  arrival.egg_in_base = map_in_base * standing.egg_in_map;
  arrival.deviation = arrival.egg_in_base - working_point;
  arrival.by_control = believed_egg - working_point;
  arrival.by_egg = egg_from_believed - believed_egg;
  arrival.by_localisation = arrival.egg_in_base - egg_from_believed;
  arrival.heading_error = std::atan2(arrival.egg_in_base.y(), arrival.egg_in_base.x());
  arrival.position_error = distance(standing.robot_in_map, standing.believed_robot_in_map);
  arrival.yaw_error =
      angle_difference(standing.believed_robot_in_map.yaw, standing.robot_in_map.yaw);
  return arrival;
}

Cause cause_of_miss(const Arrival& arrival, const robot::WorkingRange& range) {
  if (range.contains(arrival.deviation)) return Cause::kNone;
  struct Source {
    Cause cause;
    Eigen::Vector2d part;
  };
  const std::array<Source, 3> sources{{{Cause::kLocalisationError, arrival.by_localisation},
                                       {Cause::kEggPositionError, arrival.by_egg},
                                       {Cause::kControlError, arrival.by_control}}};
  Cause cause = Cause::kErrorsTogether;
  double best = 1.0;
  for (const Source& source : sources) {
    const double left = share_of_range(arrival.deviation - source.part, range);
    if (left > best) continue;
    best = left;
    cause = source.cause;
  }
  return cause;
}

}  // namespace coop::referee
