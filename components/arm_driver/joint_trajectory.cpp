#include "arm_driver/joint_trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace coop::arm_driver {

JointTrajectory::JointTrajectory(std::vector<JointVector> path, const MotionLimits& limits)
    : path_(std::move(path)) {
  // The steepest and the most curved place of the path for each joint; sampled where it is bent.
  JointVector slope = JointVector::Zero(path_.front().size());
  JointVector curvature = slope;
  const int samples = path_.size() > 2 ? 50 * static_cast<int>(path_.size() - 1) : 1;
  for (int i = 0; i <= samples; ++i) {
    const PathPoint point = path_at(static_cast<double>(i) / samples);
    slope = slope.cwiseMax(point.slope.cwiseAbs());
    curvature = curvature.cwiseMax(point.curvature.cwiseAbs());
  }
  if (samples > 1) {
    constexpr double kMargin = 1.01;  // for what lies between the samples
    slope *= kMargin;
    curvature *= kMargin;
  }
  const double steepest = (slope.array() / limits.velocity.array()).maxCoeff();
  if (steepest < 1e-9) return;
  // Half of the acceleration at most goes into the bends, the rest is left for the ramps.
  const double bend = (curvature.array() / limits.acceleration.array()).maxCoeff();
  constexpr double kSmall = 1e-9;
  speed_ = 1.0 / steepest;
  if (bend > kSmall) speed_ = std::min(speed_, std::sqrt(0.5 / bend));
  const double for_ramps = 1.0 - bend * speed_ * speed_;
  const double acceleration = for_ramps / (slope.array() / limits.acceleration.array()).maxCoeff();
  // A short path has no time for the full speed: the ramps meet in its middle.
  speed_ = std::min(speed_, std::sqrt(acceleration / 1.5));
  ramp_ = 1.5 * speed_ / acceleration;
  duration_ = 1.0 / speed_ + ramp_;
}

JointTrajectory::Progress JointTrajectory::progress_at(double time) const {
  if (time <= 0.0 && duration_ > 0.0) return {0.0, 0.0};
  if (time >= duration_) return {1.0, 0.0};
  const auto rise = [this](double x) {
    return Progress{speed_ * ramp_ * x * x * x * (1.0 - 0.5 * x), speed_ * x * x * (3.0 - 2.0 * x)};
  };
  if (time < ramp_) return rise(time / ramp_);
  const double left = duration_ - time;
  if (left >= ramp_) return {speed_ * (time - 0.5 * ramp_), speed_};
  const Progress mirrored = rise(left / ramp_);
  return {1.0 - mirrored.u, mirrored.du};
}

JointTrajectory::PathPoint JointTrajectory::path_at(double u) const {
  PathPoint point;
  const auto segments = static_cast<double>(path_.size() - 1);
  if (path_.size() == 1) {
    point.position = path_.front();
    point.slope = point.curvature = JointVector::Zero(point.position.size());
    return point;
  }
  const double along = std::clamp(u, 0.0, 1.0) * segments;
  const auto i = std::min(static_cast<std::size_t>(along), path_.size() - 2);
  const double x = along - static_cast<double>(i);
  const JointVector& from = path_[i];
  const JointVector& to = path_[i + 1];
  const JointVector before = i > 0 ? path_[i - 1] : JointVector(2.0 * from - to);
  const JointVector after = i + 2 < path_.size() ? path_[i + 2] : JointVector(2.0 * to - from);
  const JointVector a = 0.5 * (3.0 * (from - to) + after - before);
  const JointVector b = 0.5 * (2.0 * before - 5.0 * from + 4.0 * to - after);
  const JointVector c = 0.5 * (to - before);
  point.position = ((a * x + b) * x + c) * x + from;
  point.slope = segments * ((3.0 * a * x + 2.0 * b) * x + c);
  point.curvature = segments * segments * (6.0 * a * x + 2.0 * b);
  return point;
}

JointTrajectory::Sample JointTrajectory::at(double time) const {
  const Progress progress = progress_at(time);
  const PathPoint point = path_at(progress.u);
  return {point.position, point.slope * progress.du};
}

}  // namespace coop::arm_driver
