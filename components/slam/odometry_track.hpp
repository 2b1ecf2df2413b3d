#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace coop::slam {

/// All of odometry since the start, by stamp: to look up the pose at a scan, and for the trajectory
/// in the end. Kept whole, so a scan may wait as long as it likes.
class OdometryTrack {
 public:
  enum class Absence {
    kNotYet,  ///< the stamp lies after the newest reading
    kTooOld,  ///< the stamp lies before the oldest reading: will not come
  };

  /// At most `limit` readings; the older half is thinned to every second one when it is reached.
  explicit OdometryTrack(std::size_t limit = 4'000'000) : limit_(limit) {}

  /// Readings that run back in time are sorted in; of equal stamps the later comes behind. One that
  /// is there already, told again by a driver that was restarted, changes nothing.
  void insert(const StampedPose2& base_in_odom);

  /// Pose at the stamp, interpolated; the last of those that bear just this stamp.
  [[nodiscard]] Result<Pose2, Absence> at(Time stamp) const;

  [[nodiscard]] std::span<const StampedPose2> readings() const { return readings_; }
  void clear() { readings_.clear(); }

 private:
  void thin();

  std::size_t limit_;
  std::vector<StampedPose2> readings_;
};

}  // namespace coop::slam
