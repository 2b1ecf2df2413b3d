#pragma once
#include <cstdint>
#include <vector>

#include "amcl/particle_set.hpp"
#include "amcl/pose_histogram.hpp"
#include "core/pose_estimate.hpp"

namespace coop::amcl {

/// Deviation of the position along its worst direction, m.
[[nodiscard]] double position_stddev(const PoseEstimate& pose);

/// The heaviest cluster of a particle set: one hypothesis about where the robot is, instead of a
/// mean over several.
struct Cluster {
  PoseEstimate pose;
  double share = 0.0;        ///< of the total weight
  std::size_t clusters = 0;  ///< how many there are
  std::size_t bins =
      0;  ///< bins that hold more than a tenth of one particle's even share of the weight
};

/// Clusters are connected components of filled bins.
class ClusterFinder {
 public:
  ClusterFinder(double bin_size, double yaw_bin_size, std::size_t max_particles)
      : histogram_(bin_size, yaw_bin_size, max_particles) {}

  /// Mean (circular in yaw) and covariance of the heaviest cluster. The particles' weights need not
  /// be normalised; the set must not be empty.
  [[nodiscard]] Cluster heaviest(const ParticleSet& particles);

 private:
  PoseHistogram histogram_;
  std::vector<std::uint32_t> bin_of_particle_;
  std::vector<std::uint32_t> labels_;
  std::vector<double> weights_;
};

}  // namespace coop::amcl
