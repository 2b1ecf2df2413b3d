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
/// together, as fast as the limits allow. The speed along the path is a trapezoid whose ramps are
/// smooth, 3 x^2 - 2 x^3, so the acceleration does not jump along a straight path; a ramp that
/// rises to speed V within time R has the peak acceleration 1.5 V / R. Through more than two
/// positions the path is a uniform Catmull-Rom spline; they should lie about equally far apart.
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
  struct Progress {
    double u = 0.0;   ///< 0 at the start of the path, 1 at its end
    double du = 0.0;  ///< 1/s
  };
  [[nodiscard]] PathPoint path_at(double u) const;
  [[nodiscard]] Progress progress_at(double time) const;

  std::vector<JointVector> path_;
  double speed_ = 0.0;  ///< greatest du, 1/s
  double ramp_ = 0.0;   ///< s
  double duration_ = 0.0;
};

}  // namespace coop::arm_driver
