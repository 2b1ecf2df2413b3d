#include "capture/mcap/encode.hpp"

#include <limits>
#include <stdexcept>

#include "capture/mcap/crc.hpp"

namespace coop::mcap {
namespace {

std::uint32_t checked_length(std::size_t length) {
  if (length > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("MCAP: a field of " + std::to_string(length) +
                            " bytes; the format holds at most 4294967295");
  }
  return static_cast<std::uint32_t>(length);
}

void string_map(ByteBuffer& out, const std::map<std::string, std::string>& map) {
  const std::size_t begin = out.begin_array();
  for (const auto& [key, value] : map) {
    out.string(key);
    out.string(value);
  }
  out.end_array(begin);
}

/// A record from here to the end of the block.
class Record {
 public:
  Record(ByteBuffer& out, Opcode opcode, Padding padding)
      : out_(out), padding_(padding), begin_(out.begin(opcode)) {}
  ~Record() {
    if (padding_ == Padding::kThreeBytes) {
      out_.u8(0x01);
      out_.u8(0xFF);
      out_.u8(0xFF);
    }
    out_.end(begin_);
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

 private:
  ByteBuffer& out_;
  Padding padding_;
  std::size_t begin_;
};

}  // namespace

void ByteBuffer::string(std::string_view text) {
  u32(checked_length(text.size()));
  raw(std::as_bytes(std::span(text)));
}

std::size_t ByteBuffer::begin(Opcode opcode) {
  u8(static_cast<std::uint8_t>(opcode));
  u64(0);
  return bytes_.size();
}

void ByteBuffer::end(std::size_t begin) {
  patch(begin - sizeof(std::uint64_t), static_cast<std::uint64_t>(bytes_.size() - begin));
}

std::size_t ByteBuffer::begin_array() {
  u32(0);
  return bytes_.size();
}

void ByteBuffer::end_array(std::size_t begin) {
  patch(begin - sizeof(std::uint32_t), checked_length(bytes_.size() - begin));
}

void encode(ByteBuffer& out, const Header& record, Padding padding) {
  const Record frame(out, Opcode::kHeader, padding);
  out.string(record.profile);
  out.string(record.library);
}

void encode(ByteBuffer& out, const Schema& record, Padding padding) {
  const Record frame(out, Opcode::kSchema, padding);
  out.u16(record.id);
  out.string(record.name);
  out.string(record.encoding);
  out.string(record.data);
}

void encode(ByteBuffer& out, const Channel& record, Padding padding) {
  const Record frame(out, Opcode::kChannel, padding);
  out.u16(record.id);
  out.u16(record.schema_id);
  out.string(record.topic);
  out.string(record.message_encoding);
  string_map(out, record.metadata);
}

void encode(ByteBuffer& out, const Message& record) {
  out.u8(static_cast<std::uint8_t>(Opcode::kMessage));
  out.u64(kMessagePrefix + record.data.size());
  out.u16(record.channel_id);
  out.u32(record.sequence);
  out.u64(record.log_time);
  out.u64(record.publish_time);
  out.raw(record.data);
}

void encode_before_records(ByteBuffer& out, const Chunk& record) {
  constexpr std::size_t kFixed = 8 + 8 + 8 + 4 + 4 + 8;
  out.u8(static_cast<std::uint8_t>(Opcode::kChunk));
  out.u64(kFixed + record.compression.size() + record.records.size());
  out.u64(record.message_start_time);
  out.u64(record.message_end_time);
  out.u64(record.uncompressed_size);
  out.u32(record.uncompressed_crc);
  out.string(record.compression);
  out.u64(record.records.size());
}

void encode(ByteBuffer& out, std::uint16_t channel_id, std::span<const MessageIndexEntry> entries,
            Padding padding) {
  const Record frame(out, Opcode::kMessageIndex, padding);
  out.u16(channel_id);
  const std::size_t begin = out.begin_array();
  for (const MessageIndexEntry& entry : entries) {
    out.u64(entry.log_time);
    out.u64(entry.offset);
  }
  out.end_array(begin);
}

void encode(ByteBuffer& out, const ChunkIndex& record, Padding padding) {
  const Record frame(out, Opcode::kChunkIndex, padding);
  out.u64(record.message_start_time);
  out.u64(record.message_end_time);
  out.u64(record.chunk_start_offset);
  out.u64(record.chunk_length);
  const std::size_t begin = out.begin_array();
  for (const auto& [channel, offset] : record.message_index_offsets) {
    out.u16(channel);
    out.u64(offset);
  }
  out.end_array(begin);
  out.u64(record.message_index_length);
  out.string(record.compression);
  out.u64(record.compressed_size);
  out.u64(record.uncompressed_size);
}

void encode(ByteBuffer& out, const Attachment& record, Padding padding) {
  const Record frame(out, Opcode::kAttachment, padding);
  const std::size_t begin = out.size();
  out.u64(record.log_time);
  out.u64(record.create_time);
  out.string(record.name);
  out.string(record.media_type);
  out.u64(record.data.size());
  out.raw(record.data);
  out.u32(crc32_of(out.view().subspan(begin)));
}

void encode(ByteBuffer& out, const AttachmentIndex& record, Padding padding) {
  const Record frame(out, Opcode::kAttachmentIndex, padding);
  out.u64(record.offset);
  out.u64(record.length);
  out.u64(record.log_time);
  out.u64(record.create_time);
  out.u64(record.data_size);
  out.string(record.name);
  out.string(record.media_type);
}

void encode(ByteBuffer& out, const Statistics& record, Padding padding) {
  const Record frame(out, Opcode::kStatistics, padding);
  out.u64(record.message_count);
  out.u16(record.schema_count);
  out.u32(record.channel_count);
  out.u32(record.attachment_count);
  out.u32(record.metadata_count);
  out.u32(record.chunk_count);
  out.u64(record.message_start_time);
  out.u64(record.message_end_time);
  const std::size_t begin = out.begin_array();
  for (const auto& [channel, count] : record.channel_message_counts) {
    out.u16(channel);
    out.u64(count);
  }
  out.end_array(begin);
}

void encode(ByteBuffer& out, const Metadata& record, Padding padding) {
  const Record frame(out, Opcode::kMetadata, padding);
  out.string(record.name);
  string_map(out, record.metadata);
}

void encode(ByteBuffer& out, const MetadataIndex& record, Padding padding) {
  const Record frame(out, Opcode::kMetadataIndex, padding);
  out.u64(record.offset);
  out.u64(record.length);
  out.string(record.name);
}

void encode(ByteBuffer& out, const SummaryOffset& record, Padding padding) {
  const Record frame(out, Opcode::kSummaryOffset, padding);
  out.u8(static_cast<std::uint8_t>(record.group_opcode));
  out.u64(record.group_start);
  out.u64(record.group_length);
}

void encode(ByteBuffer& out, const DataEnd& record) {
  const Record frame(out, Opcode::kDataEnd, Padding::kNone);
  out.u32(record.data_section_crc);
}

void encode(ByteBuffer& out, const Footer& record) {
  const Record frame(out, Opcode::kFooter, Padding::kNone);
  out.u64(record.summary_start);
  out.u64(record.summary_offset_start);
  out.u32(record.summary_crc);
}

}  // namespace coop::mcap
