#pragma once
#include <filesystem>
#include <set>

#include "core/time.hpp"

namespace coop::test {

/// What a log holds.
struct RecordedDrive {
  std::filesystem::path file;
  std::set<Time> odometry;  ///< stamps of all records: laser lines carry odometry too
  std::set<Time> scans;
};

/// Writes a CARMEN log of 30 s: a robot goes round in a room of 10 m x 8 m with boxes, odometry
/// (which drifts) every 0.1 s, a scan of 181 beams every 0.2 s.
RecordedDrive record_drive(const std::filesystem::path& file);

}  // namespace coop::test
