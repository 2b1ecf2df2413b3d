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

/// Ends of beams, each from where the laser was at its time.
class BeamPlacer {
 public:
  BeamPlacer(const LaserScan& scan, const Pose2& laser_in_base, const Pose2& sweep)
      : scan_(scan),
        laser_in_base_(laser_in_base),
        sweep_(sweep),
        step_(scan.ranges.size() > 1 ? 1.0 / static_cast<double>(scan.ranges.size() - 1) : 0.0) {}

  [[nodiscard]] Eigen::Vector2f end(std::size_t beam, double range) const {
    const double angle = static_cast<double>(scan_.angle_min) +
                         static_cast<double>(beam) * static_cast<double>(scan_.angle_increment);
    const Eigen::Vector2d in_laser{range * std::cos(angle), range * std::sin(angle)};
    const Pose2 moved = interpolate(Pose2{}, sweep_, static_cast<double>(beam) * step_);
    return (moved * (laser_in_base_ * in_laser)).cast<float>();
  }

 private:
  const LaserScan& scan_;
  Pose2 laser_in_base_;
  Pose2 sweep_;
  double step_;
};

}  // namespace

ScanPoints to_points(const LaserScan& scan, const Pose2& laser_in_base, const Pose2& sweep,
                     const ScanPointsConfig& config) {
  ScanPoints points;
  points.laser_in_base = laser_in_base.position();
  const BeamPlacer placer(scan, laser_in_base, sweep);
  const double open_range = std::min(config.map_range, static_cast<double>(scan.range_max));
  const auto spacing = static_cast<float>(config.min_spacing);
  std::vector<Eigen::Vector2f> matchable;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const auto range = static_cast<double>(scan.ranges[i]);
    if (scan.is_hit(i)) {
      const Eigen::Vector2f end = placer.end(i, range);
      if (range > config.map_range) {
        points.open_ends.push_back(placer.end(i, config.map_range));
      } else {
        points.ends.push_back(end);
      }
      if (range > config.match_range) continue;
      if (matchable.empty() || (end - matchable.back()).norm() >= spacing) matchable.push_back(end);
    } else if (config.clear_without_return && range > open_range) {
      points.open_ends.push_back(placer.end(i, open_range));
    }
  }
  points.match = thinned(matchable, static_cast<std::size_t>(config.max_match_points));
  return points;
}

}  // namespace coop::slam
