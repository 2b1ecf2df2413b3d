#include "dwa/tracked_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace coop::dwa {
namespace {

constexpr double kSearchBack = 0.2;   ///< m
constexpr double kSearchAhead = 0.6;  ///< m
constexpr double kHeadingArm =
    0.3;  ///< m: how a wrong heading counts when the nearest pose is looked for
constexpr double kShortSegment = 0.02;  ///< m: not worth a stop

double mismatch(const Pose2& a, const Pose2& b) {
  const double turn = kHeadingArm * angle_difference(a.yaw, b.yaw);
  return (a.position() - b.position()).squaredNorm() + turn * turn;
}

}  // namespace

void TrackedPath::clear() {
  poses_.clear();
  distances_.clear();
  segments_.clear();
  segment_ = 0;
  progress_ = 0.0;
}

void TrackedPath::set(std::vector<Pose2> poses, const Pose2& robot) {
  clear();
  if (poses.size() < 2) return;
  poses_ = std::move(poses);
  distances_.assign(poses_.size(), 0.0);
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const Pose2 step = poses_[i - 1].inverse() * poses_[i];
    distances_[i] = distances_[i - 1] + std::hypot(step.x, step.y);
    const int direction = step.x < 0.0 ? -1 : 1;
    if (segments_.empty() || segments_.back().direction != direction) {
      segments_.push_back({i - 1, i, direction});
    }
    segments_.back().last = i;
  }
  join(robot);
  follow(robot);
}

/// A plan begins where the robot is. One that began long ago (this program was restarted on the
/// way) is joined where it fits best.
void TrackedPath::join(const Pose2& robot) {
  if (distance(poses_.front(), robot) < kSearchAhead) return;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    if (mismatch(poses_[i], robot) < mismatch(poses_[nearest], robot)) nearest = i;
  }
  progress_ = distances_[nearest];
  while (!on_last_segment() && segment().last < nearest) ++segment_;
}

void TrackedPath::follow(const Pose2& robot) {
  const Segment& now = segment();
  const double low = std::max(distances_[now.first], progress_ - kSearchBack);
  const double high = std::min(distances_[now.last], progress_ + kSearchAhead);
  double best = std::numeric_limits<double>::infinity();
  double found = progress_;
  for (std::size_t i = now.first; i <= now.last; ++i) {
    if (distances_[i] < low || distances_[i] > high) continue;
    const double error = mismatch(poses_[i], robot);
    if (error >= best) continue;
    best = error;
    found = distances_[i] + (poses_[i].inverse() * robot).x * now.direction;
  }
  progress_ = std::clamp(found, low, high);
}

void TrackedPath::next_segment() {
  while (!on_last_segment()) {
    ++segment_;
    progress_ = distances_[segment().first];
    if (on_last_segment() || distances_[segment().last] - progress_ > kShortSegment) return;
  }
}

double TrackedPath::to_segment_end(const Pose2& robot) const {
  const double along = distances_[segment().last] - progress_;
  if (along > kSearchAhead) return along;
  // Near the end what counts is the line across its pose.
  return -(poses_[segment().last].inverse() * robot).x * direction();
}

double TrackedPath::offset(const Pose2& robot) const {
  return distance(pose_ahead(0.0), robot);
}

Pose2 TrackedPath::pose_ahead(double ahead) const {
  const Segment& now = segment();
  const double wanted = progress_ + ahead;
  if (wanted >= distances_[now.last]) {
    return poses_[now.last] * Pose2{now.direction * (wanted - distances_[now.last]), 0.0, 0.0};
  }
  const auto begin = distances_.begin() + static_cast<std::ptrdiff_t>(now.first) + 1;
  const auto end = distances_.begin() + static_cast<std::ptrdiff_t>(now.last) + 1;
  const auto next = std::lower_bound(begin, end, wanted);
  const auto i = static_cast<std::size_t>(next - distances_.begin());
  const double step = distances_[i] - distances_[i - 1];
  const double ratio = step > 0.0 ? (wanted - distances_[i - 1]) / step : 0.0;
  return interpolate(poses_[i - 1], poses_[i], std::max(0.0, ratio));
}

}  // namespace coop::dwa
