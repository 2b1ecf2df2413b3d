#pragma once
#include "amcl/particle_set.hpp"
#include "core/config/fields.hpp"
#include "core/random.hpp"

namespace coop::amcl {

/// Noise of the odometry. Every error is a random walk: its variance grows linearly with the
/// distance driven and the angle turned, so that one step and the same way cut into many steps give
/// the same spread. Hence the units.
struct ArcMotionConfig {
  double distance_noise_per_distance = 0.04;  ///< m / sqrt(m)
  double distance_noise_per_turn = 0.02;      ///< m / sqrt(rad)
  double yaw_noise_per_distance = 0.04;       ///< rad / sqrt(m)
  double yaw_noise_per_turn = 0.08;           ///< rad / sqrt(rad)
  double slip_noise_per_distance = 0.02;      ///< m / sqrt(m), sideways

  void describe(config::Fields& fields);
};

/// Motion of a car-like base whose reference point is the middle of the rear axle: between two
/// odometry poses it drives an arc of length s while turning by theta, without moving sideways.
/// Noise is added to (s, theta), as in the velocity model of Thrun, Burgard and Fox (Probabilistic
/// Robotics, 2005, section 5.3), not to the turn-drive-turn triple of their odometry model (5.4):
/// this base cannot turn on the spot. Deviations: variances grow linearly with s and theta (see the
/// config); a measured sideways remainder (curvature that changed within the step) is kept; small
/// slip noise stands for the tyres.
///
/// Moments of one straight step d: var(along) = a_dd^2 d, var(yaw) = a_yd^2 d, var(across) = a_yd^2
/// d^3 / 3 + a_sd^2 d. The term d^3 / 3 is that of continuous driving: half a step's heading error
/// gives d^3 / 4, the rest comes with the slip.
class ArcMotionModel {
 public:
  explicit ArcMotionModel(const ArcMotionConfig& config) : config_(config) {}

  /// Moves every particle by `motion` (pose now, in base_link of the step before) plus noise.
  void apply(ParticleSet& particles, const Pose2& motion, RandomStream& random) const;

 private:
  ArcMotionConfig config_;
};

}  // namespace coop::amcl
