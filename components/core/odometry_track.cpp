#include "core/odometry_track.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace coop {
namespace {

constexpr double kJoint = 0.05;        // m and rad, between what two sources tell of one pose
constexpr double kLongestJoint = 0.2;  // s for which a source may have gone on unheard, at 1 m/s

}  // namespace

void OdometryRestart::describe(config::Fields& fields) {
  fields.number("plausible_speed", plausible_speed,
                {.unit = "m/s, rad/s",
                 .help = "odometry that goes faster was restarted",
                 .min = 0.1,
                 .max = 100});
  fields.number("slack", slack,
                {.unit = "s", .help = "by which stamps may be wrong", .min = 0.0, .max = 10.0});
}

bool OdometryTrack::insert(const StampedPose2& base_in_odom, std::string_view source) {
  if (readings_.size() >= limit_) thin();
  const bool restarted = begins_anew(base_in_odom, source);
  if (restarted) begin_piece(base_in_odom);
  if (!source.empty()) source_ = source;
  StampedPose2 reading = base_in_odom;
  if (const auto piece = piece_at(reading.stamp); piece > 0) {
    reading.pose = pieces_[piece - 1].odom_in_track * reading.pose;
  }
  if (readings_.empty() || readings_.back().stamp < reading.stamp) {
    readings_.push_back(reading);
    return restarted;
  }
  const auto same = std::ranges::equal_range(readings_, reading.stamp, {}, &StampedPose2::stamp);
  const bool repeated = std::ranges::any_of(
      same, [&](const StampedPose2& other) { return other.pose == reading.pose; });
  if (!repeated) readings_.insert(same.end(), reading);
  return restarted;
}

bool OdometryTrack::begins_anew(const StampedPose2& base_in_odom, std::string_view source) const {
  if (readings_.empty()) return false;
  const Pose2 base_in_track = odom_in_track() * base_in_odom.pose;
  const bool same_source = source.empty() || source_.empty() || source == source_;
  const double elapsed = to_seconds(base_in_odom.stamp - readings_.back().stamp);
  const auto is_within = [&](const Pose2& before, double reach) {
    const Pose2 step = before.inverse() * base_in_track;
    return std::hypot(step.x, step.y) <= reach && std::abs(step.yaw) <= reach;
  };
  if (same_source) {
    return elapsed >= 0.0 &&
           !is_within(readings_.back().pose, restart_.plausible_speed * (elapsed + restart_.slack));
  }
  // A driver that kept its state over its death goes on, or repeats the last that it told.
  const auto known = at(base_in_odom.stamp);
  if (known) return !is_within(known->base_in_odom, kJoint);
  return elapsed < 0.0 ||
         !is_within(readings_.back().pose, kJoint + std::min(elapsed, kLongestJoint));
}

void OdometryTrack::begin_piece(const StampedPose2& base_in_odom) {
  pieces_.push_back({base_in_odom.stamp, readings_.back().pose * base_in_odom.pose.inverse()});
  // A successor whose clock lags has the last word on its own time.
  const auto later =
      std::ranges::lower_bound(readings_, base_in_odom.stamp, {}, &StampedPose2::stamp);
  readings_.erase(later, readings_.end());
}

std::uint32_t OdometryTrack::piece_at(Time stamp) const {
  std::size_t piece = pieces_.size();
  while (piece > 0 && stamp < pieces_[piece - 1].begin) --piece;
  return static_cast<std::uint32_t>(piece);
}

Result<OdometryFix, OdometryTrack::Absence> OdometryTrack::at(Time stamp) const {
  const auto after = std::ranges::upper_bound(readings_, stamp, {}, &StampedPose2::stamp);
  if (after == readings_.begin()) {
    return fail(readings_.empty() ? Absence::kNotYet : Absence::kTooOld);
  }
  const auto before = std::prev(after);
  const std::uint32_t piece = piece_at(stamp);
  if (before->stamp == stamp) return OdometryFix{before->pose, piece};
  if (after == readings_.end()) return fail(Absence::kNotYet);
  if (piece_at(after->stamp) != piece) return fail(Absence::kGap);
  const double ratio = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return OdometryFix{interpolate(before->pose, after->pose, ratio), piece};
}

void OdometryTrack::resume(std::vector<StampedPose2> base_in_track, const Pose2& odom_in_track,
                           std::string_view source) {
  clear();
  readings_ = std::move(base_in_track);
  if (!readings_.empty()) pieces_.push_back({readings_.front().stamp, odom_in_track});
  source_ = source;
}

void OdometryTrack::clear() {
  readings_.clear();
  pieces_.clear();
  source_.clear();
}

void OdometryTrack::thin() {
  const std::size_t half = readings_.size() / 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < half; i += 2) readings_[kept++] = readings_[i];
  readings_.erase(readings_.begin() + static_cast<std::ptrdiff_t>(kept),
                  readings_.begin() + static_cast<std::ptrdiff_t>(half));
}

}  // namespace coop
