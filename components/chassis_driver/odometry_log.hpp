#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/carmen/carmen_log.hpp"
#include "core/odometry.hpp"

namespace coop::chassis_driver {

/// The odometry of a CARMEN log, in order of its stamps: ODOM lines and the odometry that laser
/// lines carry, so that the pose at a scan's stamp is the recorded one and not one interpolated
/// between readings with jittering stamps.
class OdometryLog {
 public:
  /// Throws std::runtime_error where there is no odometry.
  explicit OdometryLog(const std::vector<carmen::Record>& records);

  [[nodiscard]] std::size_t size() const { return readings_.size(); }
  [[nodiscard]] const Odometry& operator[](std::size_t index) const { return readings_[index]; }
  /// First and last stamp of all odometry and laser records.
  [[nodiscard]] Time begin() const { return begin_; }
  [[nodiscard]] Time end() const { return end_; }

 private:
  std::vector<Odometry> readings_;
  Time begin_{};
  Time end_{};
};

}  // namespace coop::chassis_driver
