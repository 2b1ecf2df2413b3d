#pragma once
#include <vector>

#include "arm_driver/kinematic_chain.hpp"

namespace coop::arm_driver {

/// Largest speeds and accelerations, one for each joint, all positive.
struct MotionLimits {
  JointVector velocity;      ///< rad/s
  JointVector acceleration;  ///< rad/s2
};

/// Motion from rest to rest along a path through joint positions, all joints starting and stopping
/// together, as fast as the limits allow. The way along the path is the quintic polynomial
///   u(s) = 10 s^3 - 15 s^4 + 6 s^5,  s = t / duration
/// (no jump of acceleration at the ends). Through more than two positions the path is a uniform
/// Catmull-Rom spline; they should lie about equally far apart.
class JointTrajectory {
 public:
  struct Sample {
    JointVector positions;
    JointVector velocities;
  };

  JointTrajectory() = default;
  /// At least one position; of one position the motion lasts no time.
  JointTrajectory(std::vector<JointVector> path, const MotionLimits& limits);

  [[nodiscard]] double duration() const { return duration_; }  ///< s
  /// At `time` s after the start, the first position before and the last after the motion.
  [[nodiscard]] Sample at(double time) const;
  [[nodiscard]] const JointVector& goal() const { return path_.back(); }

 private:
  struct PathPoint {
    JointVector position;
    JointVector slope;      ///< first derivative after u
    JointVector curvature;  ///< second derivative after u
  };
  [[nodiscard]] PathPoint path_at(double u) const;

  std::vector<JointVector> path_;
  double duration_ = 0.0;
};

}  // namespace coop::arm_driver
