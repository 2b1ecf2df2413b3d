#include "slam/odometry_track.hpp"

#include <algorithm>
#include <iterator>

namespace coop::slam {

void OdometryTrack::insert(const StampedPose2& base_in_odom) {
  if (readings_.size() >= limit_) thin();
  if (readings_.empty() || readings_.back().stamp < base_in_odom.stamp) {
    readings_.push_back(base_in_odom);
    return;
  }
  const auto same =
      std::ranges::equal_range(readings_, base_in_odom.stamp, {}, &StampedPose2::stamp);
  const bool repeated = std::ranges::any_of(
      same, [&](const StampedPose2& reading) { return reading.pose == base_in_odom.pose; });
  if (!repeated) readings_.insert(same.end(), base_in_odom);
}

Result<Pose2, OdometryTrack::Absence> OdometryTrack::at(Time stamp) const {
  const auto after = std::ranges::upper_bound(readings_, stamp, {}, &StampedPose2::stamp);
  if (after == readings_.begin()) {
    return fail(readings_.empty() ? Absence::kNotYet : Absence::kTooOld);
  }
  const auto before = std::prev(after);
  if (before->stamp == stamp) return before->pose;
  if (after == readings_.end()) return fail(Absence::kNotYet);
  const double ratio = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return interpolate(before->pose, after->pose, ratio);
}

void OdometryTrack::thin() {
  const std::size_t half = readings_.size() / 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < half; i += 2) readings_[kept++] = readings_[i];
  readings_.erase(readings_.begin() + static_cast<std::ptrdiff_t>(kept),
                  readings_.begin() + static_cast<std::ptrdiff_t>(half));
}

}  // namespace coop::slam
