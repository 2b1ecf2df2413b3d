#pragma once
#include <vector>

#include "core/pose.hpp"

namespace coop::dwa {

/// The last metres the robot drove, in odom: ground that is known to be wide enough.
class DrivenTrack {
 public:
  void record(const Pose2& base_in_odom) {
    if (poses_.empty() || distance(poses_.back(), base_in_odom) >= kSpacing) {
      if (poses_.size() == kMaxPoses) poses_.erase(poses_.begin());
      poses_.push_back(base_in_odom);
    }
  }
  void clear() { poses_.clear(); }

  /// Poses from the robot back along the track, at most `length` metres; forgets them.
  [[nodiscard]] std::vector<Pose2> take_back(const Pose2& base_in_odom, double length) {
    std::vector<Pose2> back{base_in_odom};
    double driven = 0.0;
    while (!poses_.empty() && driven < length) {
      const double step = distance(back.back(), poses_.back());
      if (step > 0.5 * kSpacing) {
        driven += step;
        back.push_back(poses_.back());
      }
      poses_.pop_back();
    }
    return back;
  }

 private:
  static constexpr double kSpacing = 0.05;  // m
  static constexpr std::size_t kMaxPoses = 60;
  std::vector<Pose2> poses_;
};

}  // namespace coop::dwa
