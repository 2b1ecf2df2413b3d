#pragma once
#include "capture/mcap/file_writer.hpp"
#include "capture/mcap/record_stream.hpp"

namespace coop::mcap {

struct RecoverReport {
  bool was_complete = false;            // the file had all of its parts, undamaged
  std::uint64_t messages = 0;           // in the new file
  std::uint64_t chunks = 0;             // copied as they were
  std::uint64_t salvaged_messages = 0;  // ... of them from a chunk cut in two, or from no chunk
  std::uint64_t attachments = 0;
  std::uint64_t metadata = 0;

  std::uint64_t lost_chunks = 0;
  /// By channel, as far as the indexes behind the lost chunks tell.
  std::map<std::uint16_t, std::uint64_t> lost_messages;
  std::uint64_t lost_attachments = 0;
  std::uint64_t skipped_bytes = 0;  // that belong to no record
  /// What was wrong, in the order of the file: "byte 4711: Chunk: it has been damaged: ...". At
  /// most kMostNotes; `further_notes` counts the rest.
  std::vector<std::string> notes;
  std::uint64_t further_notes = 0;
  std::map<std::uint16_t, Channel> channels;  // of the new file

  static constexpr std::size_t kMostNotes = 100;
};

struct RecoverOptions {
  ReadLimits limits;
  Layout layout;
  /// Of chunks that had to be made anew; the others stay as they are.
  Compression compression = Compression::kZstd;
  int level = 3;
};

/// Reads what is left of a file and writes it to `sink` as a complete one: whole chunks as they
/// are, with their indexes made anew; of a chunk cut by the file's end the whole messages before
/// the cut; messages outside of chunks in chunks. A chunk whose CRC differs is left out, and what
/// follows damage is found by its signature. Throws FileError for what is no MCAP file at all,
/// std::system_error where reading or writing fails.
[[nodiscard]] RecoverReport recover(const std::shared_ptr<const Source>& source,
                                    std::unique_ptr<Sink> sink, const RecoverOptions& options = {});

}  // namespace coop::mcap
