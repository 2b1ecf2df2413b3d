#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "capture/traffic/kept_files.hpp"
#include "capture/traffic/recording.hpp"
#include "capture/traffic/topic_names.hpp"
#include "core/config/fields.hpp"

namespace coop::capture {

struct RecordConfig {
  std::vector<std::string> topics;   ///< patterns; none: all
  std::vector<std::string> exclude;  ///< patterns
  std::string output;                ///< folder; empty: captures/ in the run's folder
  double last = 0.0;                 ///< s; 0: everything goes to disk
  bool save_on_fault = true;
  bool save_on_emergency_stop = true;
  double save_delay = 1.0;  ///< s between what happened and the writing of the ring
  int ring_size = 512;      ///< MB
  /// Where a ring outlives its recorder, to be written by the next one; empty: it does not.
  std::string ring_folder = "/dev/shm";
  int keep = 20;            ///< captures of faults; 0: all
  int keep_size = 1000;     ///< MB, of all captures of faults; 0: no limit
  int disk_reserve = 64;    ///< MB of the disk that are left to others: journals, logs
  double split_size = 0.0;  ///< MB; 0: one file
  double split_time = 0.0;  ///< s; 0: one file
  std::string compression = "zstd";
  double chunk_age = 1.0;  ///< s
  int queue_size = 256;    ///< MB
  bool attachments = true;

  void describe(config::Fields& fields);
  void validate() const;
  [[nodiscard]] std::uint64_t disk_reserve_bytes() const {
    return static_cast<std::uint64_t>(disk_reserve) << 20U;
  }
  /// For captures that nobody asked for, before one of that size is written.
  [[nodiscard]] KeptLimits limits_before(std::uint64_t size) const;
  [[nodiscard]] TopicSelection selection() const { return {topics, exclude}; }
  [[nodiscard]] RecordingOptions recording(const std::filesystem::path& path) const;
};

}  // namespace coop::capture
