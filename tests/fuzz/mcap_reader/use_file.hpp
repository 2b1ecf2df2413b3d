#pragma once
#include <cstdlib>

#include "capture/mcap/reader.hpp"
#include "capture/mcap/recover.hpp"

/// What a program does with a file; anything but a FileError is a finding.
namespace coop::mcap::fuzz {

inline ReadLimits limits() {
  ReadLimits limits;
  limits.max_chunk = std::uint64_t{1} << 20U;
  limits.max_record = std::uint64_t{1} << 20U;
  limits.chunk_cache = 4096;
  return limits;
}

inline void require(bool condition) {
  if (!condition) std::abort();
}

/// Number of messages up to the first error.
inline std::uint64_t read_all(const std::shared_ptr<const Source>& source,
                              const Selection& selection, bool must_be_whole) {
  std::uint64_t messages = 0;
  try {
    Reader reader(source, limits());
    if (must_be_whole) require(reader.summary().complete && !reader.summary().scanned);
    for (const AttachmentIndex& index : reader.summary().attachments) {
      try {
        static_cast<void>(reader.attachment(index));
      } catch (const FileError&) {
        require(!must_be_whole);
      }
    }
    for (const MetadataIndex& index : reader.summary().metadata) {
      try {
        static_cast<void>(reader.metadata(index));
      } catch (const FileError&) {
        require(!must_be_whole);
      }
    }
    Nanoseconds last = 0;
    MessageCursor cursor = reader.messages(selection);
    while (const auto read = cursor.next()) {
      require(read->channel != nullptr && selection.has(read->message.log_time));
      if (must_be_whole) require(read->message.log_time >= last);
      last = read->message.log_time;
      ++messages;
    }
  } catch (const FileError&) {
    require(!must_be_whole);
  }
  return messages;
}

inline void recover_and_read(const std::shared_ptr<const Source>& source) {
  std::vector<std::byte> out;
  RecoverReport report;
  try {
    RecoverOptions options;
    options.limits = limits();
    report = recover(source, write_to_memory(out), options);
  } catch (const FileError&) {
    return;
  }
  require(read_all(open_memory(std::move(out)), {}, true) == report.messages);
}

}  // namespace coop::mcap::fuzz
