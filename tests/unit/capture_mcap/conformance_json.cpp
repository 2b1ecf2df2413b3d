#include "unit/capture_mcap/conformance_json.hpp"

#include <algorithm>
#include <fstream>

#include "capture/mcap/file_writer.hpp"

namespace coop::mcap::conformance {
namespace {

using nlohmann::json;

/// The fields of a record of the suite.
class Fields {
 public:
  explicit Fields(const json& record) {
    for (const json& field : record.at("fields")) fields_[field.at(0)] = field.at(1);
  }
  [[nodiscard]] std::uint64_t number(const char* name) const { return std::stoull(text(name)); }
  [[nodiscard]] std::uint16_t id(const char* name) const {
    return static_cast<std::uint16_t>(number(name));
  }
  [[nodiscard]] std::string text(const char* name) const { return fields_.at(name); }
  [[nodiscard]] std::string bytes(const char* name) const {
    std::string bytes;
    for (const json& byte : fields_.at(name)) {
      bytes.push_back(static_cast<char>(std::stoi(byte.get<std::string>())));
    }
    return bytes;
  }
  [[nodiscard]] std::map<std::string, std::string> map(const char* name) const {
    return fields_.at(name);
  }

 private:
  std::map<std::string, json> fields_;
};

json decimal(std::uint64_t number) {
  return std::to_string(number);
}

json decimals(Bytes bytes) {
  json out = json::array();
  for (const std::byte byte : bytes) out.push_back(decimal(std::to_integer<unsigned>(byte)));
  return out;
}

template <class Map>
json decimal_map(const Map& map) {
  json out = json::object();
  for (const auto& [key, value] : map) out[std::to_string(key)] = decimal(value);
  return out;
}

json record_of(const char* type, std::initializer_list<std::pair<const char*, json>> fields) {
  json list = json::array();
  for (const auto& [name, value] : fields) list.push_back(json::array({name, value}));
  return {{"type", type}, {"fields", list}};
}

json told(const Message& message) {
  return record_of("Message", {{"channel_id", decimal(message.channel_id)},
                               {"data", decimals(message.data)},
                               {"log_time", decimal(message.log_time)},
                               {"publish_time", decimal(message.publish_time)},
                               {"sequence", decimal(message.sequence)}});
}

json told_data(const RawRecord& raw) {
  switch (raw.opcode) {
    case Opcode::kHeader: {
      const Header r = decode_header(raw);
      return record_of("Header", {{"library", r.library}, {"profile", r.profile}});
    }
    case Opcode::kSchema: {
      const Schema r = decode_schema(raw);
      return record_of("Schema", {{"data", decimals(std::as_bytes(std::span(r.data)))},
                                  {"encoding", r.encoding},
                                  {"id", decimal(r.id)},
                                  {"name", r.name}});
    }
    case Opcode::kChannel: {
      const Channel r = decode_channel(raw);
      return record_of("Channel", {{"id", decimal(r.id)},
                                   {"message_encoding", r.message_encoding},
                                   {"metadata", json(r.metadata)},
                                   {"schema_id", decimal(r.schema_id)},
                                   {"topic", r.topic}});
    }
    case Opcode::kMessage:
      return told(decode_message(raw));
    case Opcode::kAttachment: {
      const Attachment r = decode_attachment(raw);
      return record_of("Attachment", {{"create_time", decimal(r.create_time)},
                                      {"data", decimals(r.data)},
                                      {"log_time", decimal(r.log_time)},
                                      {"media_type", r.media_type},
                                      {"name", r.name}});
    }
    case Opcode::kMetadata: {
      const Metadata r = decode_metadata(raw);
      return record_of("Metadata", {{"metadata", json(r.metadata)}, {"name", r.name}});
    }
    case Opcode::kDataEnd:
      return record_of("DataEnd",
                       {{"data_section_crc", decimal(decode_data_end(raw).data_section_crc)}});
    default:
      return nullptr;
  }
}

json told_summary(const RawRecord& raw) {
  switch (raw.opcode) {
    case Opcode::kChunkIndex: {
      const ChunkIndex r = decode_chunk_index(raw);
      return record_of("ChunkIndex",
                       {{"chunk_length", decimal(r.chunk_length)},
                        {"chunk_start_offset", decimal(r.chunk_start_offset)},
                        {"compressed_size", decimal(r.compressed_size)},
                        {"compression", r.compression},
                        {"message_end_time", decimal(r.message_end_time)},
                        {"message_index_length", decimal(r.message_index_length)},
                        {"message_index_offsets", decimal_map(r.message_index_offsets)},
                        {"message_start_time", decimal(r.message_start_time)},
                        {"uncompressed_size", decimal(r.uncompressed_size)}});
    }
    case Opcode::kAttachmentIndex: {
      const AttachmentIndex r = decode_attachment_index(raw);
      return record_of("AttachmentIndex", {{"create_time", decimal(r.create_time)},
                                           {"data_size", decimal(r.data_size)},
                                           {"length", decimal(r.length)},
                                           {"log_time", decimal(r.log_time)},
                                           {"media_type", r.media_type},
                                           {"name", r.name},
                                           {"offset", decimal(r.offset)}});
    }
    case Opcode::kStatistics: {
      const Statistics r = decode_statistics(raw);
      return record_of("Statistics",
                       {{"attachment_count", decimal(r.attachment_count)},
                        {"channel_count", decimal(r.channel_count)},
                        {"channel_message_counts", decimal_map(r.channel_message_counts)},
                        {"chunk_count", decimal(r.chunk_count)},
                        {"message_count", decimal(r.message_count)},
                        {"message_end_time", decimal(r.message_end_time)},
                        {"message_start_time", decimal(r.message_start_time)},
                        {"metadata_count", decimal(r.metadata_count)},
                        {"schema_count", decimal(r.schema_count)}});
    }
    case Opcode::kMetadataIndex: {
      const MetadataIndex r = decode_metadata_index(raw);
      return record_of(
          "MetadataIndex",
          {{"length", decimal(r.length)}, {"name", r.name}, {"offset", decimal(r.offset)}});
    }
    case Opcode::kSummaryOffset: {
      const SummaryOffset r = decode_summary_offset(raw);
      return record_of("SummaryOffset",
                       {{"group_length", decimal(r.group_length)},
                        {"group_opcode", decimal(static_cast<unsigned>(r.group_opcode))},
                        {"group_start", decimal(r.group_start)}});
    }
    case Opcode::kFooter: {
      const Footer r = decode_footer(raw);
      return record_of("Footer", {{"summary_crc", decimal(r.summary_crc)},
                                  {"summary_offset_start", decimal(r.summary_offset_start)},
                                  {"summary_start", decimal(r.summary_start)}});
    }
    default:
      return nullptr;
  }
}

void tell(const RawRecord& raw, json& out) {
  json record = told_data(raw);
  if (record.is_null()) record = told_summary(raw);
  if (!record.is_null()) out.push_back(std::move(record));
}

Schema schema_of(const Fields& f) {
  return {f.id("id"), f.text("name"), f.text("encoding"), f.bytes("data")};
}
Channel channel_of(const Fields& f) {
  return {f.id("id"), f.id("schema_id"), f.text("topic"), f.text("message_encoding"),
          f.map("metadata")};
}

/// One record of the data section, into the chunk or the file.
void write_record(const json& record, FileWriter& file, ChunkBuilder* chunk) {
  const std::string type = record.at("type");
  const Fields f(record);
  const auto into_either = [&](const auto& value) {
    if (chunk == nullptr) return file.add(value);
    chunk->add(value);
    if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, Message>)
      file.note_in_chunk(value);
  };
  if (type == "Schema") into_either(schema_of(f));
  if (type == "Channel") into_either(channel_of(f));
  if (type == "Message") {
    const std::string data = f.bytes("data");
    into_either(Message{f.id("channel_id"), static_cast<std::uint32_t>(f.number("sequence")),
                        f.number("log_time"), f.number("publish_time"),
                        std::as_bytes(std::span(data))});
  }
  if (type == "Attachment") {
    const std::string data = f.bytes("data");
    file.add(Attachment{f.number("log_time"), f.number("create_time"), f.text("name"),
                        f.text("media_type"), std::as_bytes(std::span(data))});
  }
  if (type == "Metadata") file.add(Metadata{f.text("name"), f.map("metadata")});
}

}  // namespace

Case load(const std::filesystem::path& path) {
  const json file = json::parse(std::ifstream(path));
  return {path.stem().string(), file.at("meta").at("variant").at("features"), file.at("records")};
}

std::vector<std::byte> write(const Case& one) {
  Layout layout;
  layout.message_index = one.has("mx");
  layout.chunk_index = one.has("chx");
  layout.attachment_index = one.has("ax");
  layout.metadata_index = one.has("mdx");
  layout.statistics = one.has("st");
  layout.repeated_schemas = one.has("rsh");
  layout.repeated_channels = one.has("rch");
  layout.summary_offsets = one.has("sum");
  layout.padding = one.has("pad") ? Padding::kThreeBytes : Padding::kNone;
  std::vector<std::byte> bytes;
  FileWriter file(write_to_memory(bytes), {"", ""}, layout);
  // Padding is for the records of the file, not for those of its chunks.
  ChunkBuilder chunk;
  const bool chunked = one.has("ch");
  for (const json& record : one.records) {
    if (record.at("type") == "DataEnd") break;
    write_record(record, file, chunked ? &chunk : nullptr);
  }
  Compressor none(Compression::kNone, 0);
  ByteBuffer buffer;
  if (chunked) file.add(make_ready(chunk, none, buffer));
  file.finish();
  return bytes;
}

nlohmann::json read_records(std::vector<std::byte> bytes) {
  const auto source = open_memory(std::move(bytes));
  const ReadLimits limits;
  json out = json::array();
  RecordStream stream(source, limits, kMagic.size(), source->size() - kMagic.size());
  Decompressor decompressor;
  std::vector<std::byte> records;
  while (const auto place = stream.next()) {
    const RawRecord raw = stream.content();
    if (place->opcode != Opcode::kChunk) {
      tell(raw, out);
      continue;
    }
    decompressor.decompress(decode_chunk(raw), place->offset, limits.max_chunk, records);
    RecordCursor cursor(records);
    RawRecord inner;
    while (cursor.next(inner)) tell(inner, out);
  }
  return out;
}

nlohmann::json read_messages(Reader& reader) {
  json out = json::array();
  MessageCursor cursor = reader.messages();
  while (const auto read = cursor.next()) out.push_back(told(read->message));
  return out;
}

nlohmann::json messages_by_time(const Case& one) {
  std::vector<json> messages;
  for (const json& record : one.records) {
    if (record.at("type") == "Message") messages.push_back(record);
  }
  std::ranges::stable_sort(messages, {},
                           [](const json& record) { return Fields(record).number("log_time"); });
  return messages;
}

std::size_t count(const Case& one, const std::string& type) {
  return static_cast<std::size_t>(std::ranges::count_if(
      one.records, [&](const json& record) { return record.at("type") == type; }));
}

}  // namespace coop::mcap::conformance
