#include "capture/node/record_config.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/config/error.hpp"

namespace coop::capture {

void RecordConfig::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kCompressions{"zstd", "lz4", "none"};
  fields.texts("topics", topics,
               {.help = "patterns of topics to record (globs, or regular expressions behind re:); "
                        "none: all"});
  fields.texts("exclude", exclude, {.help = "patterns of topics to leave out"});
  fields.text("output", output, {.help = "folder; empty: captures/ in the run's folder"});
  fields.number("last", last,
                {.unit = "s",
                 .help = "keep that much in memory and write it when something happens; 0: write "
                         "everything",
                 .min = 0,
                 .max = 86400});
  fields.flag("save_on_fault", save_on_fault,
              {.help = "write the ring when a component degrades or dies"});
  fields.flag("save_on_emergency_stop", save_on_emergency_stop,
              {.help = "write the ring on emergency stop"});
  fields.number("save_delay", save_delay,
                {.unit = "s",
                 .help = "the ring is written that long after what happened",
                 .min = 0,
                 .max = 600});
  fields.integer("ring_size", ring_size,
                 {.unit = "MB", .help = "memory for the ring, compressed", .min = 1, .max = 65536});
  fields.text("ring_folder", ring_folder,
              {.help = "folder, in memory, where the ring outlives a recorder that is killed, for "
                       "the next one to write it to disk; empty: it does not"});
  fields.integer(
      "keep", keep,
      {.help = "captures of faults in the folder, the oldest go; 0: all (those asked for "
               "stay)",
       .min = 0,
       .max = 100000});
  fields.integer("keep_size", keep_size,
                 {.unit = "MB",
                  .help = "of all captures of faults together, the oldest go; 0: no limit",
                  .min = 0,
                  .max = 1000000});
  fields.integer("disk_reserve", disk_reserve,
                 {.unit = "MB",
                  .help = "of the disk that are left to others (journals, logs): older captures of "
                          "faults go, or nothing is written",
                  .min = 0,
                  .max = 1000000});
  fields.number("split_size", split_size,
                {.unit = "MB", .help = "size of a file; 0: no limit", .min = 0, .max = 1e6});
  fields.number("split_time", split_time,
                {.unit = "s", .help = "length of a file; 0: no limit", .min = 0, .max = 1e6});
  fields.choice("compression", compression, kCompressions, {.help = "of chunks"});
  fields.number("chunk_age", chunk_age,
                {.unit = "s",
                 .help = "a chunk is written at the latest then: what a crash can cost",
                 .min = 0.1,
                 .max = 60});
  fields.integer(
      "queue_size", queue_size,
      {.unit = "MB", .help = "memory for what waits for the disk", .min = 8, .max = 65536});
  fields.flag("attachments", attachments,
              {.help = "launch file, configurations, maps and robot go into the capture"});
}

void RecordConfig::validate() const {
  try {
    selection().validate();
  } catch (const std::invalid_argument& problem) {
    throw config::Error(std::string("topics, exclude: ") + problem.what());
  }
}

KeptLimits RecordConfig::limits_before(std::uint64_t size) const {
  KeptLimits limits{.free_bytes = size + disk_reserve_bytes()};
  if (keep > 0) limits.count = static_cast<std::size_t>(keep) - 1;
  if (keep_size > 0) {
    const std::uint64_t most = static_cast<std::uint64_t>(keep_size) << 20U;
    limits.bytes = most - std::min(most, size);
  }
  return limits;
}

RecordingOptions RecordConfig::recording(const std::filesystem::path& path) const {
  RecordingOptions options;
  options.path = path;
  options.last = seconds(last);
  options.ring_bytes = static_cast<std::size_t>(ring_size) << 20U;
  options.rings = ring_folder;
  options.split_bytes = static_cast<std::uint64_t>(split_size * 1e6);
  options.split_time = seconds(split_time);
  options.writer.compression =
      mcap::compression_named(compression == "none" ? std::string_view() : compression);
  options.writer.file.reserve = disk_reserve_bytes();
  options.writer.chunk_age = static_cast<mcap::Nanoseconds>(seconds(chunk_age).count());
  options.writer.queue_bytes = static_cast<std::size_t>(queue_size) << 20U;
  return options;
}

}  // namespace coop::capture
