#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "core/carmen/carmen_log.hpp"
#include "core/config/fields.hpp"
#include "core/scan.hpp"

namespace coop::lidar_driver {

/// Which part of a log to play; the base's driver must be told the same.
struct LogSection {
  double start = 0.0;     ///< s after the first stamp of the log
  double duration = 0.0;  ///< s; 0: to its end

  void describe(config::Fields& fields);
};

/// The scans of a CARMEN log's front laser, in order of their stamps, and how far they were handed
/// out.
class ScanLog {
 public:
  /// Throws std::runtime_error where the section holds no scan.
  ScanLog(const std::vector<carmen::Record>& records, const LogSection& section,
          const std::string& frame_id);

  /// The next scan if its stamp is not after `until`, else nothing. It stays the next until pop().
  [[nodiscard]] const LaserScan* next(Time until) const;
  void pop() { ++next_; }
  /// Goes on behind the first `scans` scans.
  void skip(std::size_t scans) { next_ = std::min(scans, scans_.size()); }

  /// Scans handed out.
  [[nodiscard]] std::size_t position() const { return next_; }
  /// First and last stamp.
  [[nodiscard]] Time begin() const { return scans_.front().stamp; }
  [[nodiscard]] Time end() const { return scans_.back().stamp; }

  [[nodiscard]] bool at_end() const { return next_ == scans_.size(); }
  [[nodiscard]] std::size_t size() const { return scans_.size(); }

 private:
  std::vector<LaserScan> scans_;
  std::size_t next_ = 0;
};

}  // namespace coop::lidar_driver
