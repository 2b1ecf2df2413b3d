#include "core/transform_buffer.hpp"

#include <algorithm>

namespace coop {
namespace {

Pose3 to_pose(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  Pose3 pose = Pose3::Identity();
  pose.translation() = translation;
  pose.linear() = rotation.toRotationMatrix();
  return pose;
}

}  // namespace

std::string_view to_string(TransformError error) {
  switch (error) {
    case TransformError::kUnknownFrame:
      return "unknown frame";
    case TransformError::kNotConnected:
      return "frames not connected";
    case TransformError::kNotYet:
      return "not yet known at this time";
    case TransformError::kTooOld:
      return "no longer known at this time";
  }
  return "unknown error";
}

int TransformBuffer::find(std::string_view name) const {
  const auto found = index_.find(std::string(name));
  return found == index_.end() ? -1 : found->second;
}

int TransformBuffer::frame_index(std::string_view name) {
  const auto [entry, is_new] =
      index_.try_emplace(std::string(name), static_cast<int>(frames_.size()));
  if (is_new) {
    frames_.emplace_back();
    frames_.back().name = name;
  }
  return entry->second;
}

void TransformBuffer::insert(std::string_view parent, std::string_view child, Time stamp,
                             const Pose3& child_in_parent) {
  const int parent_index = frame_index(parent);
  Frame& frame = frames_[static_cast<std::size_t>(frame_index(child))];
  if (frame.parent != parent_index || frame.is_static) frame.samples.clear();
  frame.parent = parent_index;
  frame.is_static = false;
  const Sample sample{stamp, child_in_parent.translation(),
                      Eigen::Quaterniond(child_in_parent.linear())};
  auto& samples = frame.samples;
  if (!samples.empty() && stamp < samples.back().stamp - history_) samples.clear();
  const auto place =
      std::upper_bound(samples.begin(), samples.end(), stamp,
                       [](Time time, const Sample& other) { return time < other.stamp; });
  if (place != samples.begin() && std::prev(place)->stamp == stamp) {
    *std::prev(place) = sample;  // the later word counts
  } else {
    samples.insert(place, sample);
  }
  const Time oldest = samples.back().stamp - history_;
  while (samples.front().stamp < oldest) samples.pop_front();
}

void TransformBuffer::insert_static(std::string_view parent, std::string_view child,
                                    const Pose3& child_in_parent) {
  const int parent_index = frame_index(parent);
  Frame& frame = frames_[static_cast<std::size_t>(frame_index(child))];
  frame.parent = parent_index;
  frame.is_static = true;
  frame.samples.assign(
      1, {Time{}, child_in_parent.translation(), Eigen::Quaterniond(child_in_parent.linear())});
}

Result<Pose3, TransformError> TransformBuffer::sample_at(const Frame& frame, Time stamp) {
  const auto& samples = frame.samples;
  if (frame.is_static) return to_pose(samples.front().translation, samples.front().rotation);
  if (samples.empty()) return fail(TransformError::kNotYet);
  if (stamp > samples.back().stamp) return fail(TransformError::kNotYet);
  if (stamp < samples.front().stamp) return fail(TransformError::kTooOld);
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), stamp,
                       [](const Sample& other, Time time) { return other.stamp < time; });
  if (after->stamp == stamp) return to_pose(after->translation, after->rotation);
  const auto before = std::prev(after);
  const double ratio = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return to_pose(before->translation + ratio * (after->translation - before->translation),
                 before->rotation.slerp(ratio, after->rotation));
}

Result<std::pair<std::vector<int>, std::vector<int>>, TransformError> TransformBuffer::chains(
    std::string_view target, std::string_view source) const {
  const int target_index = find(target);
  const int source_index = find(source);
  if (target_index < 0 || source_index < 0) return fail(TransformError::kUnknownFrame);
  const auto to_root = [this](int frame) {
    std::vector<int> chain;
    // The bound breaks a loop that contradicting publishers may have made.
    while (frame >= 0 && chain.size() <= frames_.size()) {
      chain.push_back(frame);
      frame = frames_[static_cast<std::size_t>(frame)].parent;
    }
    return chain;
  };
  std::vector<int> up = to_root(source_index);
  std::vector<int> down = to_root(target_index);
  if (up.back() != down.back()) return fail(TransformError::kNotConnected);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    up.pop_back();
    down.pop_back();
  }
  return std::pair{std::move(up), std::move(down)};
}

Result<Pose3, TransformError> TransformBuffer::lookup(std::string_view target,
                                                      std::string_view source, Time stamp) const {
  if (target == source) return Pose3::Identity();
  const auto paths = chains(target, source);
  if (!paths) return fail(paths.error());
  const auto compose = [&](const std::vector<int>& chain) -> Result<Pose3, TransformError> {
    Pose3 pose = Pose3::Identity();
    for (const int index : chain) {
      const auto step = sample_at(frames_[static_cast<std::size_t>(index)], stamp);
      if (!step) return step;
      pose = *step * pose;
    }
    return pose;
  };
  const auto source_in_common = compose(paths->first);
  if (!source_in_common) return source_in_common;
  const auto target_in_common = compose(paths->second);
  if (!target_in_common) return target_in_common;
  return target_in_common->inverse() * *source_in_common;
}

Result<Time, TransformError> TransformBuffer::newest_stamp(std::string_view target,
                                                           std::string_view source) const {
  if (target == source) return Time::max();
  const auto paths = chains(target, source);
  if (!paths) return fail(paths.error());
  Time newest = Time::max();
  for (const auto* chain : {&paths->first, &paths->second}) {
    for (const int index : *chain) {
      const Frame& frame = frames_[static_cast<std::size_t>(index)];
      if (frame.is_static) continue;
      if (frame.samples.empty()) return fail(TransformError::kNotYet);
      newest = std::min(newest, frame.samples.back().stamp);
    }
  }
  return newest;
}

void TransformBuffer::clear_history() {
  for (Frame& frame : frames_) {
    if (!frame.is_static) frame.samples.clear();
  }
}

std::optional<StampedPose2> newest_pose(const TransformBuffer& transforms, std::string_view target,
                                        std::string_view source, Time now, Duration max_age) {
  const auto newest = transforms.newest_stamp(target, source);
  if (!newest || (*newest < now && now - *newest > max_age)) return std::nullopt;
  const auto pose = transforms.lookup(target, source, *newest);
  if (!pose) return std::nullopt;
  return StampedPose2{std::min(*newest, now), to_pose2(*pose)};
}

}  // namespace coop
