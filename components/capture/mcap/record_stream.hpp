#pragma once
#include <memory>
#include <optional>

#include "capture/mcap/decode.hpp"
#include "capture/mcap/source.hpp"

namespace coop::mcap {

/// Bounds on what a file may make its reader allocate.
struct ReadLimits {
  std::uint64_t max_chunk = std::uint64_t{1} << 30U;      // bytes, uncompressed
  std::uint64_t max_record = std::uint64_t{4} << 30U;     // bytes; never more than the file has
  std::uint64_t chunk_cache = std::uint64_t{256} << 20U;  // bytes of uncompressed chunks held
};

/// The records of a file as they lie there, from a place to the end: reads only what is asked for,
/// so that a large attachment may be passed over.
class RecordStream {
 public:
  /// Of a record at top level.
  struct Place {
    Opcode opcode{};
    std::uint64_t offset = 0;
    std::uint64_t content_length = 0;
    [[nodiscard]] std::uint64_t end() const { return offset + kRecordPrefix + content_length; }
  };

  /// Begins at `offset` and ends at `end`.
  RecordStream(std::shared_ptr<const Source> source, const ReadLimits& limits, std::uint64_t offset,
               std::uint64_t end);

  /// The next record; nothing at the end. Throws FileError for one that is none (opcode 0) or
  /// reaches beyond the end; seek() goes on elsewhere then.
  std::optional<Place> next();
  /// The content of the record that next() gave, or its first bytes. Valid until the next call.
  /// Throws FileError where it is longer than the limit.
  [[nodiscard]] RawRecord content();
  [[nodiscard]] RawRecord content_prefix(std::uint64_t length);
  /// Of any bytes of the file within the bounds given.
  [[nodiscard]] Bytes bytes(std::uint64_t offset, std::uint64_t length);
  void seek(std::uint64_t offset) { position_ = offset; }
  [[nodiscard]] std::uint64_t position() const { return position_; }
  [[nodiscard]] std::uint64_t end() const { return end_; }

 private:
  std::shared_ptr<const Source> source_;
  ReadLimits limits_;
  std::uint64_t position_;
  std::uint64_t end_;
  Place place_;
  /// A window of the file: small records come many to a read.
  std::vector<std::byte> window_;
  std::uint64_t window_begin_ = 0;
  std::size_t window_size_ = 0;
};

/// Checks the magic at the begin and reads the Header behind it; its end is where the data section
/// begins. Throws FileError.
struct FileBegin {
  Header header;
  std::uint64_t data_begin = 0;
};
[[nodiscard]] FileBegin read_begin(const std::shared_ptr<const Source>& source,
                                   const ReadLimits& limits);

}  // namespace coop::mcap
