#pragma once
#include <cstddef>
#include <vector>

#include "amcl/particle_set.hpp"
#include "amcl/pose_histogram.hpp"
#include "core/config/fields.hpp"
#include "core/random.hpp"

namespace coop::amcl {

struct KldConfig {
  int min_particles = 500;
  int max_particles = 20000;     ///< reached only while the pose is open
  double error = 0.05;           ///< bound on the Kullback-Leibler distance to the true posterior
  double quantile = 2.33;        ///< upper standard normal quantile: 2.33 holds the bound with 99 %
  double bin_size = 0.25;        ///< m
  double yaw_bin_size = 0.1745;  ///< rad

  void describe(config::Fields& fields);
  void validate() const;
};

/// Particles needed so that a sample over `bins` filled bins keeps within the error (Fox, Adapting
/// the Sample Size in Particle Filters Through KLD-Sampling, IJRR 2003, equation 7: the
/// Wilson-Hilferty approximation of chi-square).
[[nodiscard]] std::size_t kld_bound(std::size_t bins, double error, double quantile);

/// KLD-sampling (Fox 2003, table 3) with low-variance draws. The number of draws is not known
/// beforehand, so the evenly spaced comb of the low-variance sampler cannot be laid out; instead
/// draw j takes the particle at the fraction (u + j * golden ratio) mod 1 of the cumulative weight,
/// u uniform. Every beginning of that sequence is nearly evenly spaced (three-gap theorem), each
/// draw alone is uniform, so it is unbiased, with a variance close to the comb's at whatever draw
/// it ends.
class Resampler {
 public:
  explicit Resampler(const KldConfig& config);

  /// Fills `to` (cleared first) from `from`; each draw comes from `fresh` instead with probability
  /// `fresh_share` (augmented MCL, Probabilistic Robotics, table 8.3). Weights need not be
  /// normalised; those of the result are 1 / size. Draws from `fresh` do not count as filled bins,
  /// or a few of them would ask for the largest sample.
  void resample(const ParticleSet& from, double fresh_share, const ParticleSet& fresh,
                RandomStream& random, ParticleSet& to);

 private:
  KldConfig config_;
  PoseHistogram histogram_;
  std::vector<double> cumulative_;
  std::vector<double> fresh_cumulative_;
};

}  // namespace coop::amcl
