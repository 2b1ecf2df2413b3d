#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// The records of an MCAP file, version 0, as its public specification lays them out
/// (mcap.dev/spec): a file is magic, Header, data section, DataEnd, summary section, summary
/// offset section, Footer, magic; each record is an opcode (1 byte), the length of its content
/// (uint64) and the content; all numbers little-endian.
namespace coop::mcap {

/// Nanoseconds since an epoch that the writer and its reader agree on (here: the robot's time).
using Nanoseconds = std::uint64_t;
using Bytes = std::span<const std::byte>;

inline constexpr std::array<std::byte, 8> kMagic{std::byte{0x89}, std::byte{'M'}, std::byte{'C'},
                                                 std::byte{'A'},  std::byte{'P'}, std::byte{'0'},
                                                 std::byte{'\r'}, std::byte{'\n'}};
/// Opcode and length of a record before its content, bytes.
inline constexpr std::size_t kRecordPrefix = 9;
/// Content of a Message before its data, bytes.
inline constexpr std::size_t kMessagePrefix = 22;
/// The Footer record and the magic behind it, bytes: the last of every complete file.
inline constexpr std::size_t kFooterRecord = kRecordPrefix + 20;

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

struct Header {
  std::string profile;  // "ros2" in Coop's captures
  std::string library;  // the program that wrote the file
};

struct Footer {
  std::uint64_t summary_start = 0;         // bytes from the file's begin; 0: no summary
  std::uint64_t summary_offset_start = 0;  // 0: no summary offsets
  std::uint32_t summary_crc = 0;           // 0: not computed
};

struct Schema {
  std::uint16_t id = 0;  // never 0 in a file: there 0 means "no schema"
  std::string name;      // "sensor_msgs/msg/LaserScan"
  std::string encoding;  // "ros2msg", "ros2idl", ...; empty: none
  std::string data;      // in that encoding

  friend bool operator==(const Schema&, const Schema&) = default;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  // 0: none
  std::string topic;
  std::string message_encoding;  // "cdr"
  std::map<std::string, std::string> metadata;

  friend bool operator==(const Channel&, const Channel&) = default;
};

/// `data` is a view: of the writer's caller, or of a reader's chunk (see reader.hpp for how long).
struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  Nanoseconds log_time = 0;      // recorded at; files are read in this order
  Nanoseconds publish_time = 0;  // published at; log_time where unknown
  Bytes data;
};

/// `records` is a view of the (compressed) records.
struct Chunk {
  Nanoseconds message_start_time = 0;
  Nanoseconds message_end_time = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  // 0: not computed
  std::string compression;             // "", "zstd", "lz4"
  Bytes records;
};

struct MessageIndexEntry {
  Nanoseconds log_time = 0;
  std::uint64_t offset = 0;  // of the Message record in the uncompressed chunk
};

struct MessageIndex {
  std::uint16_t channel_id = 0;
  std::vector<MessageIndexEntry> entries;
};

struct ChunkIndex {
  Nanoseconds message_start_time = 0;
  Nanoseconds message_end_time = 0;
  std::uint64_t chunk_start_offset = 0;
  std::uint64_t chunk_length = 0;  // with opcode and length
  std::vector<std::pair<std::uint16_t, std::uint64_t>> message_index_offsets;  // by channel
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

/// `data` is a view; the record's CRC is computed by the encoder and checked by the decoder.
struct Attachment {
  Nanoseconds log_time = 0;
  Nanoseconds create_time = 0;  // 0: unknown
  std::string name;
  std::string media_type;
  Bytes data;
};

struct AttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  // with opcode and length
  Nanoseconds log_time = 0;
  Nanoseconds create_time = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
};

struct Statistics {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  Nanoseconds message_start_time = 0;
  Nanoseconds message_end_time = 0;
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

struct Metadata {
  std::string name;
  std::map<std::string, std::string> metadata;
};

struct MetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  // with opcode and length
  std::string name;
};

struct SummaryOffset {
  Opcode group_opcode{};
  std::uint64_t group_start = 0;
  std::uint64_t group_length = 0;
};

struct DataEnd {
  std::uint32_t data_section_crc = 0;  // of the file's begin up to this record; 0: not computed
};

/// "Chunk", for messages to people; "record 0x42" for what the specification does not know.
[[nodiscard]] std::string name_of(Opcode opcode);

}  // namespace coop::mcap
