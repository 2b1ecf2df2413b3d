#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"

namespace coop::slam {

struct ScanPointsConfig {
  double match_range = 30.0;          ///< m, ends beyond are not matched
  double map_range = 30.0;            ///< m, the map is drawn up to here
  double min_spacing = 0.0;           ///< m between consecutive ends that are matched
  int max_match_points = 360;         ///< evenly thinned above
  bool clear_without_return = false;  ///< a beam that met nothing frees cells up to map_range

  void describe(config::Fields& fields);
};

/// A scan prepared once for all particles: beam ends in base_link as flat arrays.
struct ScanPoints {
  Eigen::Vector2d laser_in_base{0.0, 0.0};  ///< where the beams start
  std::vector<Eigen::Vector2f> ends;        ///< m, beams that hit something within map_range
  std::vector<Eigen::Vector2f> open_ends;   ///< m, beams known to be free up to here
  std::vector<Eigen::Vector2f> match;       ///< m, the ends used for matching

  [[nodiscard]] bool empty() const { return match.empty(); }
};

/// `laser_in_base` is the mount of the sensor, yaw included. `sweep` is the pose of base_link at
/// the scan's last beam seen from that at its first: beams are moved to where they belong, evenly
/// in between. The ends are in base_link at the first beam.
[[nodiscard]] ScanPoints to_points(const LaserScan& scan, const Pose2& laser_in_base,
                                   const Pose2& sweep, const ScanPointsConfig& config);

}  // namespace coop::slam
