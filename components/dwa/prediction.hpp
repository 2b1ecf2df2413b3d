#pragma once
#include <vector>

#include "core/pose.hpp"
#include "core/vehicle/ackermann.hpp"
#include "dwa/config.hpp"
#include "dwa/dynamic_window.hpp"

namespace coop::dwa {

/// The poses a command leads through, `prediction_step` apart in time; the present pose is not
/// among them.
using Trajectory = std::vector<Pose2>;

/// Equations (5) and (6), as in the paper: v and omega hold from now on over the whole prediction
/// time, and within a step the robot moves straight along its heading, which turns at the end of
/// the step:
///   x += v dt cos(theta), y += v dt sin(theta), theta += omega dt.
void predict_as_paper(const PredictionConfig& config, const Pose2& from, const Twist2& command,
                      Trajectory& trajectory);

/// The same with two deviations: speed and steering angle approach the command no faster than the
/// base lets them, and each step is an exact arc. Steering from lock to lock takes 1.5 s, so a
/// prediction that turns at once would be off by a robot's width where it matters most. The
/// prediction ends, before the prediction time, where the base has driven `max_distance` metres:
/// beyond a stopping point nothing is going to be driven.
struct RampLimits {
  double acceleration = 0.0;   ///< m/s^2
  double steering_rate = 0.0;  ///< rad/s
};
void predict_ramped(const PredictionConfig& config, const vehicle::AckermannGeometry& base,
                    const RampLimits& limits, const Pose2& from, const MotionState& now,
                    const Command& command, double max_distance, Trajectory& trajectory);

}  // namespace coop::dwa
