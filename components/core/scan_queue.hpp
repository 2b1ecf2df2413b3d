#pragma once
#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "core/odometry_track.hpp"
#include "core/scan.hpp"
#include "core/transform_buffer.hpp"

namespace coop {

/// A scan with all that is needed to use it.
struct LocatedScan {
  LaserScan scan;
  OdometryFix base_in_track;  ///< at the scan's stamp
  Pose2 sweep;                ///< base_link at the last beam, in base_link at the first
  Pose2 laser_in_base;
};

/// Scans that wait until odometry has reached them and the mount of the laser is known.
class ScanQueue {
 public:
  struct Rules {
    /// A scan older than this is given up; Duration::max(): never.
    Duration patience = std::chrono::seconds(1);
    std::size_t limit = 100;  ///< where more wait, the oldest makes room
    bool whole_sweep = true;  ///< wait for odometry at the last beam; else `sweep` is zero
  };
  explicit ScanQueue(const Rules& rules) : rules_(rules) {}

  void push(LaserScan scan);
  /// The oldest scan where all is known; nothing where it has to wait. What cannot be used is
  /// dropped on the way.
  [[nodiscard]] std::optional<LocatedScan> next(const OdometryTrack& odometry,
                                                const TransformBuffer& transforms, Time now);
  void clear() { waiting_.clear(); }

  [[nodiscard]] std::size_t size() const { return waiting_.size(); }
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  /// The scan that waits longest; the queue is not empty.
  [[nodiscard]] const LaserScan& front() const { return waiting_.front(); }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }
  /// What the scan dropped last lacked.
  [[nodiscard]] const std::string& lack() const { return lack_; }

 private:
  void drop(std::string lack);

  Rules rules_;
  std::deque<LaserScan> waiting_;
  std::size_t dropped_ = 0;
  std::string lack_;
};

}  // namespace coop
