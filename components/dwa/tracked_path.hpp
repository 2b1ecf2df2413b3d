#pragma once
#include <cstddef>
#include <vector>

#include "core/pose.hpp"

namespace coop::dwa {

/// A path being followed: it is cut where the direction of travel changes, one segment is driven
/// after the other, and progress along it never jumps, so that a path which crosses or retraces
/// itself is followed in order.
class TrackedPath {
 public:
  /// Poses as in the topic `plan`: a step against the heading is driven backwards. At least two
  /// poses, else the path is empty. `robot` is where the robot is now, in the path's frame.
  void set(std::vector<Pose2> poses, const Pose2& robot);
  void clear();
  [[nodiscard]] bool empty() const { return poses_.empty(); }

  /// Moves progress along the present segment to the point nearest to the robot.
  void follow(const Pose2& robot);

  [[nodiscard]] int direction() const { return segment().direction; }  ///< 1 forwards, -1 backwards
  [[nodiscard]] bool on_last_segment() const { return segment_ + 1 == segments_.size(); }
  void next_segment();

  /// Distance the robot still has to drive to where the segment ends, m; negative beyond.
  [[nodiscard]] double to_segment_end(const Pose2& robot) const;
  /// Along the whole path, m.
  [[nodiscard]] double to_goal() const { return distances_.back() - progress_; }
  [[nodiscard]] const Pose2& goal() const { return poses_.back(); }
  /// Distance of the robot from the path beside it, m.
  [[nodiscard]] double offset(const Pose2& robot) const;

  /// Pose `ahead` metres further along the segment; beyond its end the segment goes on straight.
  [[nodiscard]] Pose2 pose_ahead(double ahead) const;

 private:
  struct Segment {
    std::size_t first;  ///< pose
    std::size_t last;   ///< pose
    int direction;
  };
  [[nodiscard]] const Segment& segment() const { return segments_[segment_]; }
  void join(const Pose2& robot);

  std::vector<Pose2> poses_;
  std::vector<double> distances_;  ///< driven from the first pose, m
  std::vector<Segment> segments_;
  std::size_t segment_ = 0;
  double progress_ = 0.0;  ///< as distances_
};

}  // namespace coop::dwa
