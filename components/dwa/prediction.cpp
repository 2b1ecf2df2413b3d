#include "dwa/prediction.hpp"

#include <algorithm>
#include <cmath>

namespace coop::dwa {
namespace {

double approach(double from, double to, double step) {
  return from + std::clamp(to - from, -step, step);
}

int steps_of(const PredictionConfig& config) {
  return std::max(1,
                  static_cast<int>(std::lround(config.prediction_time / config.prediction_step)));
}

}  // namespace

void predict_as_paper(const PredictionConfig& config, const Pose2& from, const Twist2& command,
                      Trajectory& trajectory) {
  const double dt = config.prediction_step;
  trajectory.clear();
  Pose2 pose = from;
  for (int i = 0; i < steps_of(config); ++i) {
    pose = {pose.x + command.v * dt * std::cos(pose.yaw),
            pose.y + command.v * dt * std::sin(pose.yaw),
            normalize_angle(pose.yaw + command.omega * dt)};
    trajectory.push_back(pose);
  }
}

void predict_ramped(const PredictionConfig& config, const vehicle::AckermannGeometry& base,
                    const RampLimits& limits, const Pose2& from, const MotionState& now,
                    const Command& command, double max_distance, Trajectory& trajectory) {
  const double dt = config.prediction_step;
  trajectory.clear();
  Pose2 pose = from;
  double speed = now.speed;
  double steering = now.steering;
  double driven = 0.0;
  for (int i = 0; i < steps_of(config); ++i) {
    const double next_speed = approach(speed, command.speed, limits.acceleration * dt);
    const double next_steering = approach(steering, command.steering, limits.steering_rate * dt);
    const double distance = 0.5 * (speed + next_speed) * dt;
    const double curvature = vehicle::curvature_of(base, 0.5 * (steering + next_steering));
    pose = vehicle::advance_along_arc(pose, distance, distance * curvature);
    trajectory.push_back(pose);
    speed = next_speed;
    steering = next_steering;
    driven += std::abs(distance);
    if (driven >= max_distance) break;
  }
}

}  // namespace coop::dwa
