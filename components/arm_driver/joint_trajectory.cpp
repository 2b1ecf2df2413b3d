#include "arm_driver/joint_trajectory.hpp"

#include <algorithm>
#include <cmath>

namespace coop::arm_driver {
namespace {

/// The quintic and its derivatives after s.
struct Progress {
  double u = 0.0;
  double du = 0.0;
  double ddu = 0.0;
};

Progress progress_at(double s) {
  const double s2 = s * s;
  return {s2 * s * (10.0 - 15.0 * s + 6.0 * s2), 30.0 * s2 * (1.0 - 2.0 * s + s2),
          60.0 * s * (1.0 - 3.0 * s + 2.0 * s2)};
}

}  // namespace

JointTrajectory::JointTrajectory(std::vector<JointVector> path, const MotionLimits& limits)
    : path_(std::move(path)) {
  // Peaks of a motion that lasts 1 s; one of T seconds has 1/T of the speed, 1/T^2 of the
  // acceleration. They are sampled: the limits are kept with a margin of a percent.
  constexpr double kMargin = 1.01;
  const int samples = 100 * static_cast<int>(std::max<std::size_t>(path_.size() - 1, 1));
  double by_velocity = 0.0;
  double by_acceleration = 0.0;
  for (int i = 0; i <= samples; ++i) {
    const Progress progress = progress_at(static_cast<double>(i) / samples);
    const PathPoint point = path_at(progress.u);
    const auto velocity = point.slope.array() * progress.du;
    const auto acceleration =
        point.curvature.array() * progress.du * progress.du + point.slope.array() * progress.ddu;
    by_velocity = std::max(by_velocity, (velocity.abs() / limits.velocity.array()).maxCoeff());
    by_acceleration =
        std::max(by_acceleration, (acceleration.abs() / limits.acceleration.array()).maxCoeff());
  }
  duration_ = kMargin * std::max(by_velocity, std::sqrt(by_acceleration));
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
  const double s = duration_ > 0.0 ? std::clamp(time / duration_, 0.0, 1.0) : 1.0;
  const Progress progress = progress_at(s);
  const PathPoint point = path_at(progress.u);
  Sample sample{point.position, JointVector::Zero(point.position.size())};
  if (duration_ > 0.0) sample.velocities = point.slope * (progress.du / duration_);
  return sample;
}

}  // namespace coop::arm_driver
