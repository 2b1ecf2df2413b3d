#include "slam/scan_points.hpp"

#include <algorithm>
#include <cmath>

namespace coop::slam {

void ScanPointsConfig::describe(config::Fields& fields) {
  fields.number(
      "match_range", match_range,
      {.unit = "m", .help = "beam ends beyond are not matched", .min = 0.5, .max = 200.0});
  fields.number("map_range", map_range,
                {.unit = "m", .help = "the map is drawn up to here", .min = 0.5, .max = 200.0});
  fields.number("min_spacing", min_spacing,
                {.unit = "m",
                 .help = "between consecutive beam ends that are matched",
                 .min = 0.0,
                 .max = 1.0});
  fields.integer("max_match_points", max_match_points,
                 {.help = "beam ends matched; evenly thinned above", .min = 20, .max = 10000});
  fields.flag("clear_without_return", clear_without_return,
              {.help = "a beam that met nothing frees cells up to map_range"});
}

namespace {

std::vector<Eigen::Vector2f> thinned(const std::vector<Eigen::Vector2f>& points,
                                     std::size_t count) {
  if (points.size() <= count) return points;
  std::vector<Eigen::Vector2f> kept;
  kept.reserve(count);
  for (std::size_t i = 0; i < count; ++i) kept.push_back(points[i * points.size() / count]);
  return kept;
}

}  // namespace

ScanPoints to_points(const LaserScan& scan, const Pose2& laser_in_base,
                     const ScanPointsConfig& config) {
  ScanPoints points;
  points.laser_in_base = laser_in_base.position();
  const auto end_at = [&](std::size_t beam, double range) {
    const double angle = static_cast<double>(scan.angle_min) +
                         static_cast<double>(beam) * static_cast<double>(scan.angle_increment);
    const Eigen::Vector2d in_laser{range * std::cos(angle), range * std::sin(angle)};
    return Eigen::Vector2f((laser_in_base * in_laser).cast<float>());
  };
  std::vector<Eigen::Vector2f> matchable;
  const auto spacing = static_cast<float>(config.min_spacing);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const auto range = static_cast<double>(scan.ranges[i]);
    if (scan.is_hit(i)) {
      if (range > config.map_range) {
        points.open_ends.push_back(end_at(i, config.map_range));
      } else {
        points.ends.push_back(end_at(i, range));
      }
      if (range > config.match_range) continue;
      const Eigen::Vector2f end = end_at(i, range);
      if (matchable.empty() || (end - matchable.back()).norm() >= spacing) matchable.push_back(end);
    } else if (config.clear_without_return && range > static_cast<double>(scan.range_max)) {
      points.open_ends.push_back(
          end_at(i, std::min(config.map_range, static_cast<double>(scan.range_max))));
    }
  }
  points.match = thinned(matchable, static_cast<std::size_t>(config.max_match_points));
  return points;
}

}  // namespace coop::slam
