#pragma once
#include "capture/mcap/record_stream.hpp"

namespace coop::mcap {

/// Messages that lie in the data section outside of any chunk: the records from `offset` on.
struct LooseRun {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  Nanoseconds start_time = 0;
  Nanoseconds end_time = 0;
};

/// What is in a file, without its messages.
struct Summary {
  Header header;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  /// As the file says; counted where the file was scanned.
  std::optional<Statistics> statistics;
  std::vector<ChunkIndex> chunks;  // in the order of the file
  std::vector<AttachmentIndex> attachments;
  std::vector<MetadataIndex> metadata;
  std::vector<LooseRun> loose;  // known after a scan only

  /// False where the file has no end (its writer was killed, or it was cut): what is here was
  /// found by reading all of it up to where it makes no more sense.
  bool complete = true;
  /// True where the data section was read through: for want of a summary, or of an index.
  bool scanned = false;
  /// Why the file is incomplete, and where: "byte 4711: ...". Empty where it is complete.
  std::string defect;

  [[nodiscard]] const Schema* schema_of(const Channel& channel) const;
};

/// From the summary section alone; nothing where the file has none (or a Footer says so). Throws
/// FileError where there is one that is damaged (CRC, bounds, records), or where the file does not
/// begin or end as an MCAP file.
[[nodiscard]] std::optional<Summary> read_summary(const std::shared_ptr<const Source>& source,
                                                  const ReadLimits& limits = {});

/// By reading the data section from its begin, to DataEnd or to where it makes no more sense
/// (then `complete` is false and `defect` says why). Throws FileError only for what does not even
/// begin as an MCAP file.
[[nodiscard]] Summary scan(const std::shared_ptr<const Source>& source,
                           const ReadLimits& limits = {});

}  // namespace coop::mcap
