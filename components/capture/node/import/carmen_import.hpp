#pragma once
#include <cstdint>

#include "capture/mcap/writer.hpp"
#include "core/carmen/carmen_log.hpp"

namespace coop::capture {

struct CarmenImportOptions {
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  std::string laser_frame = "laser_link";
  Pose2 laser_in_base;  ///< published as tf_static
};

struct CarmenImportReport {
  std::uint64_t scans = 0;
  std::uint64_t odometry = 0;
  std::uint64_t mended_stamps = 0;  ///< set to that of the record before (sort_by_stamp)
};

/// Writes a log as the messages that a robot of ours would have published: `/scan` of the front
/// laser, `/odom` and `/tf` of ODOM lines and of the odometry that laser lines carry (of records
/// with one stamp the last one), `/tf_static` once. Log and publish time are the record's stamp;
/// messages are in its order. Rear lasers, corrected poses and parameters are left out. Throws
/// std::runtime_error where a stamp is before 1970 or there is neither scan nor odometry.
CarmenImportReport import_carmen(std::vector<carmen::Record> records,
                                 const CarmenImportOptions& options, mcap::Writer& writer);

}  // namespace coop::capture
