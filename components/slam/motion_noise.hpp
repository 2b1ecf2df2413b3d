#pragma once
#include <Eigen/Core>

#include "core/config/fields.hpp"
#include "core/pose.hpp"

namespace coop::slam {

/// How far odometry may be wrong. Errors are random walks: variances grow linearly with the
/// distance driven and the angle turned, so that one step and the same way cut into many give the
/// same spread.
struct MotionNoiseConfig {
  double position_per_distance = 0.1;  ///< m / sqrt(m)
  double position_per_turn = 0.08;     ///< m / sqrt(rad)
  double yaw_per_distance = 0.1;       ///< rad / sqrt(m)
  double yaw_per_turn = 0.08;          ///< rad / sqrt(rad)
  double min_position = 0.01;          ///< m, even without motion
  double min_yaw = 0.005;              ///< rad, even without motion
  double restart_position = 0.3;       ///< m, moved unseen while odometry was away
  double restart_yaw = 0.3;            ///< rad, the same

  void describe(config::Fields& fields);
};

/// Standard deviations (x m, y m, yaw rad) of the pose after the odometry step `motion`, in
/// base_link at the step's end. `restarted`: odometry was away on the way.
[[nodiscard]] Eigen::Vector3d motion_stddev(const MotionNoiseConfig& config, const Pose2& motion,
                                            bool restarted = false);

}  // namespace coop::slam
