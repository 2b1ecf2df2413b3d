#pragma once
#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace coop {

/// One sweep of a planar range finder. Beam i points at angle_min + i * angle_increment in
/// `frame_id` (x forward, yaw counter-clockwise). Ranges that are no distance speak as in REP 117:
/// +inf or any value above range_max is "nothing within range_max", the only one that frees the
/// way; below range_min (-inf too) is "something too near to measure"; NaN is no measurement and
/// says nothing.
struct LaserScan {
  Time stamp{};  ///< acquisition of the first beam
  std::string frame_id;
  float angle_min = 0.0F;        ///< rad
  float angle_increment = 0.0F;  ///< rad
  float time_increment = 0.0F;   ///< s between beams, 0 where unknown
  float scan_time = 0.0F;        ///< s between scans
  float range_min = 0.0F;        ///< m
  float range_max = 0.0F;        ///< m
  std::vector<float> ranges;     ///< m

  [[nodiscard]] float angle(std::size_t beam) const {
    return angle_min + static_cast<float>(beam) * angle_increment;
  }
  /// From the first beam to the last; zero where unknown.
  [[nodiscard]] Duration sweep_duration() const {
    const std::size_t steps = ranges.empty() ? 0 : ranges.size() - 1;
    return seconds(static_cast<double>(time_increment) * static_cast<double>(steps));
  }
  [[nodiscard]] bool is_hit(std::size_t beam) const {
    return ranges[beam] >= range_min && ranges[beam] <= range_max;  // false for NaN
  }
};

}  // namespace coop
