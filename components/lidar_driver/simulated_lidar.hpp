#pragma once
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/world/ray_caster.hpp"
#include "core/world/state.hpp"

namespace coop::lidar_driver {

/// A planar lidar of the class of indoor robots' (RPLIDAR A2): full circle, beam 0 straight back,
/// counter-clockwise.
struct SimulatedLidarConfig {
  int beams = 360;
  double range_min = 0.15;         ///< m
  double range_max = 12.0;         ///< m
  double range_noise = 0.01;       ///< m, deviation of one range
  double range_noise_share = 0.0;  ///< of the range, on top
  double mount_yaw_spread = 0.0;   ///< rad, deviation over runs of how it is mounted
  double dropout = 0.002;          ///< share of beams without a measurement, whatever is there

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// Scans of a simulated world: exact rays through its grid and against its animals, then noise.
/// Sees walls and animals, which are higher than it is mounted, not eggs. All beams of a scan are
/// of one moment. Noise is a function of seed, beam and stamp alone: a restarted driver, or one
/// that missed a scan, measures the same.
class SimulatedLidar {
 public:
  SimulatedLidar(const SimulatedLidarConfig& config, const world::World& world,
                 const Pose2& laser_in_base, std::uint64_t seed);

  /// As REP 117 has it: +inf for a beam that met nothing within range_max, -inf for what is nearer
  /// than range_min, NaN for a beam that was lost. Only the first says that the way is free.
  /// Overwrites `scan`, whose memory is used again.
  void measure(const world::GroundTruth& truth, LaserScan& scan) const;

 private:
  [[nodiscard]] double true_range(const world::GroundTruth& truth, const Eigen::Vector2d& origin,
                                  const Eigen::Vector2d& direction) const;

  SimulatedLidarConfig config_;
  world::RayCaster walls_;
  Pose2 laser_in_base_;
  std::uint64_t seed_;
  std::vector<std::string> streams_;  ///< name of each beam's number stream
};

}  // namespace coop::lidar_driver
