#include "chassis_driver/odometry_log.hpp"

#include <algorithm>
#include <stdexcept>

namespace coop::chassis_driver {

OdometryLog::OdometryLog(const std::vector<carmen::Record>& records) {
  for (const carmen::Record& record : records) {
    if (const auto* odometry = std::get_if<carmen::OdometryRecord>(&record)) {
      readings_.push_back(carmen::to_odometry(*odometry));
    } else if (const auto* laser = std::get_if<carmen::LaserRecord>(&record)) {
      readings_.push_back(carmen::to_odometry(*laser));
    }
  }
  if (readings_.empty()) throw std::runtime_error("the log holds no odometry");
  std::ranges::stable_sort(readings_, {}, &Odometry::stamp);
  // Of readings with one stamp the last written one stands.
  const auto same_stamp = [](const Odometry& a, const Odometry& b) { return a.stamp == b.stamp; };
  const auto kept = std::unique(readings_.rbegin(), readings_.rend(), same_stamp);
  readings_.erase(readings_.begin(), kept.base());
  begin_ = readings_.front().stamp;
  end_ = readings_.back().stamp;
}

}  // namespace coop::chassis_driver
