#include "capture/mcap/decode.hpp"

#include <type_traits>

#include "capture/mcap/crc.hpp"

namespace coop::mcap {
namespace {

template <class T>
T load(Bytes bytes) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value = static_cast<T>(value | static_cast<T>(static_cast<T>(bytes[i]) << (8 * i)));
  }
  return value;
}

std::map<std::string, std::string> string_map(Decoder decoder) {
  std::map<std::string, std::string> map;
  while (!decoder.at_end()) {
    const std::string_view key = decoder.string("key of its metadata");
    map.insert_or_assign(std::string(key), decoder.string("value of its metadata"));
  }
  return map;
}

}  // namespace

std::string name_of(Opcode opcode) {
  static constexpr std::array kNames{
      "",         "Header",        "Footer",        "Schema",     "Channel",         "Message",
      "Chunk",    "MessageIndex",  "ChunkIndex",    "Attachment", "AttachmentIndex", "Statistics",
      "Metadata", "MetadataIndex", "SummaryOffset", "DataEnd"};
  const auto number = static_cast<std::size_t>(opcode);
  if (number > 0 && number < kNames.size()) return kNames[number];
  static constexpr std::string_view kHex = "0123456789abcdef";
  return std::string("record 0x") + kHex[number >> 4U] + kHex[number & 15U];
}

std::uint64_t load_u64(Bytes bytes) {
  return load<std::uint64_t>(bytes);
}

void Decoder::fail(const std::string& what) const {
  throw FileError(where_, name_of(opcode_) + ": " + what);
}

Bytes Decoder::bytes(std::uint64_t length, const char* field) {
  const std::size_t left = bytes_.size() - position_;
  if (length > left) {
    fail(std::string("its ") + field + " needs " + std::to_string(length) + " bytes where " +
         std::to_string(left) + " are left");
  }
  const Bytes part = bytes_.subspan(position_, static_cast<std::size_t>(length));
  position_ += part.size();
  return part;
}

template <class T>
T Decoder::number(const char* field) {
  return load<T>(bytes(sizeof(T), field));
}

std::uint8_t Decoder::u8(const char* field) {
  return number<std::uint8_t>(field);
}
std::uint16_t Decoder::u16(const char* field) {
  return number<std::uint16_t>(field);
}
std::uint32_t Decoder::u32(const char* field) {
  return number<std::uint32_t>(field);
}
std::uint64_t Decoder::u64(const char* field) {
  return number<std::uint64_t>(field);
}

std::string_view Decoder::string(const char* field) {
  const Bytes text = bytes(u32(field), field);
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

Decoder Decoder::array(const char* field) {
  return {bytes(u32(field), field), opcode_, where_};
}

Header decode_header(const RawRecord& record) {
  Decoder in(record);
  Header header;
  header.profile = in.string("profile");
  header.library = in.string("library");
  return header;
}

Footer decode_footer(const RawRecord& record) {
  Decoder in(record);
  Footer footer;
  footer.summary_start = in.u64("summary start");
  footer.summary_offset_start = in.u64("summary offset start");
  footer.summary_crc = in.u32("summary CRC");
  return footer;
}

Schema decode_schema(const RawRecord& record) {
  Decoder in(record);
  Schema schema;
  schema.id = in.u16("id");
  schema.name = in.string("name");
  schema.encoding = in.string("encoding");
  schema.data = in.string("data");
  return schema;
}

Channel decode_channel(const RawRecord& record) {
  Decoder in(record);
  Channel channel;
  channel.id = in.u16("id");
  channel.schema_id = in.u16("schema id");
  channel.topic = in.string("topic");
  channel.message_encoding = in.string("message encoding");
  channel.metadata = string_map(in.array("metadata"));
  return channel;
}

Message decode_message(const RawRecord& record) {
  Decoder in(record);
  Message message;
  message.channel_id = in.u16("channel id");
  message.sequence = in.u32("sequence");
  message.log_time = in.u64("log time");
  message.publish_time = in.u64("publish time");
  message.data = in.rest();
  return message;
}

ChunkHead decode_chunk_head(const RawRecord& record, std::uint64_t content_length) {
  Decoder in(record);
  ChunkHead head;
  head.chunk.message_start_time = in.u64("start time");
  head.chunk.message_end_time = in.u64("end time");
  head.chunk.uncompressed_size = in.u64("uncompressed size");
  head.chunk.uncompressed_crc = in.u32("CRC");
  head.chunk.compression = in.string("compression");
  head.records_size = in.u64("size of its records");
  head.records_offset = in.position();
  if (head.records_size > content_length - head.records_offset) {
    in.fail("its records need " + std::to_string(head.records_size) + " bytes where " +
            std::to_string(content_length - head.records_offset) + " are left");
  }
  return head;
}

Chunk decode_chunk(const RawRecord& record) {
  ChunkHead head = decode_chunk_head(record, record.content.size());
  head.chunk.records = record.content.subspan(static_cast<std::size_t>(head.records_offset),
                                              static_cast<std::size_t>(head.records_size));
  return std::move(head.chunk);
}

MessageIndex decode_message_index(const RawRecord& record) {
  Decoder in(record);
  MessageIndex index;
  index.channel_id = in.u16("channel id");
  Decoder entries = in.array("entries");
  index.entries.reserve(entries.rest().size() / 16);
  while (!entries.at_end()) {
    const Nanoseconds log_time = entries.u64("log time of an entry");
    index.entries.push_back({log_time, entries.u64("offset of an entry")});
  }
  return index;
}

ChunkIndex decode_chunk_index(const RawRecord& record) {
  Decoder in(record);
  ChunkIndex index;
  index.message_start_time = in.u64("start time");
  index.message_end_time = in.u64("end time");
  index.chunk_start_offset = in.u64("chunk start");
  index.chunk_length = in.u64("chunk length");
  Decoder offsets = in.array("message index offsets");
  index.message_index_offsets.reserve(offsets.rest().size() / 10);
  while (!offsets.at_end()) {
    const std::uint16_t channel = offsets.u16("channel id");
    index.message_index_offsets.emplace_back(channel, offsets.u64("message index offset"));
  }
  index.message_index_length = in.u64("message index length");
  index.compression = in.string("compression");
  index.compressed_size = in.u64("compressed size");
  index.uncompressed_size = in.u64("uncompressed size");
  return index;
}

Attachment decode_attachment(const RawRecord& record) {
  Decoder in(record);
  Attachment attachment;
  attachment.log_time = in.u64("log time");
  attachment.create_time = in.u64("create time");
  attachment.name = in.string("name");
  attachment.media_type = in.string("media type");
  attachment.data = in.bytes(in.u64("data"), "data");
  const std::size_t checked = in.position();
  const std::uint32_t crc = in.u32("CRC");
  if (crc != 0 && crc32_of(record.content.first(checked)) != crc) {
    in.fail("'" + attachment.name + "' has been damaged: its CRC differs");
  }
  return attachment;
}

AttachmentIndex decode_attachment_index(const RawRecord& record) {
  Decoder in(record);
  AttachmentIndex index;
  index.offset = in.u64("offset");
  index.length = in.u64("length");
  index.log_time = in.u64("log time");
  index.create_time = in.u64("create time");
  index.data_size = in.u64("data size");
  index.name = in.string("name");
  index.media_type = in.string("media type");
  return index;
}

Statistics decode_statistics(const RawRecord& record) {
  Decoder in(record);
  Statistics statistics;
  statistics.message_count = in.u64("message count");
  statistics.schema_count = in.u16("schema count");
  statistics.channel_count = in.u32("channel count");
  statistics.attachment_count = in.u32("attachment count");
  statistics.metadata_count = in.u32("metadata count");
  statistics.chunk_count = in.u32("chunk count");
  statistics.message_start_time = in.u64("start time");
  statistics.message_end_time = in.u64("end time");
  Decoder counts = in.array("message counts");
  while (!counts.at_end()) {
    const std::uint16_t channel = counts.u16("channel id");
    statistics.channel_message_counts.insert_or_assign(channel, counts.u64("message count"));
  }
  return statistics;
}

Metadata decode_metadata(const RawRecord& record) {
  Decoder in(record);
  Metadata metadata;
  metadata.name = in.string("name");
  metadata.metadata = string_map(in.array("metadata"));
  return metadata;
}

MetadataIndex decode_metadata_index(const RawRecord& record) {
  Decoder in(record);
  MetadataIndex index;
  index.offset = in.u64("offset");
  index.length = in.u64("length");
  index.name = in.string("name");
  return index;
}

SummaryOffset decode_summary_offset(const RawRecord& record) {
  Decoder in(record);
  SummaryOffset offset;
  offset.group_opcode = static_cast<Opcode>(in.u8("group opcode"));
  offset.group_start = in.u64("group start");
  offset.group_length = in.u64("group length");
  return offset;
}

DataEnd decode_data_end(const RawRecord& record) {
  Decoder in(record);
  return {in.u32("data section CRC")};
}

bool RecordCursor::next(RawRecord& record) {
  if (position_ == records_.size()) return false;
  const std::uint64_t offset = base_ + position_;
  const std::uint64_t where = where_ == kOwnOffset ? offset : where_;
  const std::size_t left = records_.size() - position_;
  if (left < kRecordPrefix) {
    throw FileError(where, "a record begins " + std::to_string(left) + " bytes before the end");
  }
  record.opcode = static_cast<Opcode>(records_[position_]);
  if (record.opcode == Opcode{}) throw FileError(where, "0 is no opcode");
  const std::uint64_t length = load_u64(records_.subspan(position_ + 1));
  if (length > left - kRecordPrefix) {
    throw FileError(where, name_of(record.opcode) + ": " + std::to_string(length) +
                               " bytes long where " + std::to_string(left - kRecordPrefix) +
                               " are left");
  }
  record.offset = offset;
  record.content = records_.subspan(position_ + kRecordPrefix, static_cast<std::size_t>(length));
  position_ += kRecordPrefix + record.content.size();
  return true;
}

}  // namespace coop::mcap
