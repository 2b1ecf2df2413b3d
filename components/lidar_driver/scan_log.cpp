#include "lidar_driver/scan_log.hpp"

#include <algorithm>
#include <stdexcept>

namespace coop::lidar_driver {

void LogSection::describe(config::Fields& fields) {
  fields.number("start", start, {.unit = "s", .help = "into the log", .min = 0});
  fields.number("duration", duration,
                {.unit = "s", .help = "of the log to play; 0: to its end", .min = 0});
}

ScanLog::ScanLog(const std::vector<carmen::Record>& records, const LogSection& section,
                 const std::string& frame_id) {
  Time log_begin = Time::max();
  for (const carmen::Record& record : records) {
    if (const auto stamp = carmen::stamp_of(record)) log_begin = std::min(log_begin, *stamp);
  }
  const Time begin = log_begin + seconds(section.start);
  const Time end = section.duration > 0.0 ? begin + seconds(section.duration) : Time::max();
  for (const carmen::Record& record : records) {
    const auto* laser = std::get_if<carmen::LaserRecord>(&record);
    if (laser == nullptr || laser->rear || laser->stamp < begin || laser->stamp > end) continue;
    scans_.push_back(carmen::to_scan(*laser, frame_id));
  }
  if (scans_.empty()) throw std::runtime_error("the log holds no scan of a front laser");
  std::ranges::stable_sort(scans_, {}, &LaserScan::stamp);
}

const LaserScan* ScanLog::next(Time until) const {
  return !at_end() && scans_[next_].stamp <= until ? &scans_[next_] : nullptr;
}

}  // namespace coop::lidar_driver
