#pragma once
#include <string_view>

#include "capture/mcap/file_error.hpp"
#include "capture/mcap/records.hpp"

/// Bytes to records. Every length is checked against the record before it is believed; what does
/// not fit throws FileError. Fields behind those known are skipped, as the specification asks.
namespace coop::mcap {

/// One record as it lies in a file or in a chunk; `content` is a view.
struct RawRecord {
  Opcode opcode{};
  std::uint64_t offset = 0;  // of the opcode, from the begin of the file or of the chunk's records
  Bytes content;
};

/// Little-endian numbers, strings and arrays of a record, one after the other.
class Decoder {
 public:
  /// `where`: what an error gives as its place.
  Decoder(Bytes bytes, Opcode opcode, std::uint64_t where)
      : bytes_(bytes), opcode_(opcode), where_(where) {}
  explicit Decoder(const RawRecord& record)
      : Decoder(record.content, record.opcode, record.offset) {}

  std::uint8_t u8(const char* field);
  std::uint16_t u16(const char* field);
  std::uint32_t u32(const char* field);
  std::uint64_t u64(const char* field);
  std::string_view string(const char* field);
  Bytes bytes(std::uint64_t length, const char* field);
  /// What has its length in bytes (uint32) before it.
  Decoder array(const char* field);
  [[nodiscard]] Bytes rest() const { return bytes_.subspan(position_); }
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] bool at_end() const { return position_ == bytes_.size(); }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class T>
  T number(const char* field);

  Bytes bytes_;
  Opcode opcode_;
  std::uint64_t where_;
  std::size_t position_ = 0;
};

[[nodiscard]] Header decode_header(const RawRecord& record);
[[nodiscard]] Footer decode_footer(const RawRecord& record);
/// Id 0 is not refused here: the specification has readers ignore such a schema.
[[nodiscard]] Schema decode_schema(const RawRecord& record);
[[nodiscard]] Channel decode_channel(const RawRecord& record);
/// A view of the record.
[[nodiscard]] Message decode_message(const RawRecord& record);
[[nodiscard]] Chunk decode_chunk(const RawRecord& record);
/// The fields before a Chunk's records, from a content that may end there, and how long the
/// records are (checked against `content_length`, the record's own).
struct ChunkHead {
  Chunk chunk;
  std::uint64_t records_offset = 0;  // in the content
  std::uint64_t records_size = 0;
};
[[nodiscard]] ChunkHead decode_chunk_head(const RawRecord& record, std::uint64_t content_length);
[[nodiscard]] MessageIndex decode_message_index(const RawRecord& record);
[[nodiscard]] ChunkIndex decode_chunk_index(const RawRecord& record);
/// Checks the CRC where the record has one. The data is a view of the record.
[[nodiscard]] Attachment decode_attachment(const RawRecord& record);
[[nodiscard]] AttachmentIndex decode_attachment_index(const RawRecord& record);
[[nodiscard]] Statistics decode_statistics(const RawRecord& record);
[[nodiscard]] Metadata decode_metadata(const RawRecord& record);
[[nodiscard]] MetadataIndex decode_metadata_index(const RawRecord& record);
[[nodiscard]] SummaryOffset decode_summary_offset(const RawRecord& record);
[[nodiscard]] DataEnd decode_data_end(const RawRecord& record);

/// The records of a chunk (uncompressed), or of any other run of records in memory, in order.
class RecordCursor {
 public:
  /// `base`: added to the offsets of the records; `where`: the place that errors name (a chunk's
  /// offset), or nothing where it is the record's own offset.
  explicit RecordCursor(Bytes records, std::uint64_t base = 0, std::uint64_t where = kOwnOffset)
      : records_(records), base_(base), where_(where) {}

  /// False at the end. Throws FileError where a record reaches beyond it.
  bool next(RawRecord& record);
  [[nodiscard]] std::size_t position() const { return position_; }

  static constexpr std::uint64_t kOwnOffset = ~std::uint64_t{0};

 private:
  Bytes records_;
  std::uint64_t base_;
  std::uint64_t where_;
  std::size_t position_ = 0;
};

/// Little-endian number at the begin of `bytes`, which has to be long enough.
[[nodiscard]] std::uint64_t load_u64(Bytes bytes);

}  // namespace coop::mcap
