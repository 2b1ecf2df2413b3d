#pragma once
#include <cstring>
#include <memory_resource>
#include <string_view>

#include "capture/mcap/records.hpp"

/// Records to bytes.
namespace coop::mcap {

/// Bytes that grow at the end; clear() keeps the memory.
class ByteBuffer {
 public:
  ByteBuffer() = default;
  explicit ByteBuffer(std::pmr::memory_resource* memory) : bytes_(memory) {}

  void u8(std::uint8_t value) { bytes_.push_back(std::byte{value}); }
  void u16(std::uint16_t value) { number(value); }
  void u32(std::uint32_t value) { number(value); }
  void u64(std::uint64_t value) { number(value); }
  void raw(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  /// With its length (uint32) before it. Throws std::length_error where that does not fit.
  void string(std::string_view text);

  /// Begins a record; end() fills in its length.
  [[nodiscard]] std::size_t begin(Opcode opcode);
  void end(std::size_t begin);
  /// Begins what has its length in bytes (uint32) before it: arrays and maps.
  [[nodiscard]] std::size_t begin_array();
  void end_array(std::size_t begin);

  void clear() { bytes_.clear(); }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  void resize(std::size_t size) { bytes_.resize(size); }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::size_t capacity() const { return bytes_.capacity(); }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  [[nodiscard]] Bytes view() const { return bytes_; }
  [[nodiscard]] std::byte* data() { return bytes_.data(); }

 private:
  template <class T>
  void number(T value) {
    std::array<std::byte, sizeof(T)> little;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      little[i] = static_cast<std::byte>(value >> (8 * i));
    raw(little);
  }
  template <class T>
  void patch(std::size_t at, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_[at + i] = static_cast<std::byte>(value >> (8 * i));
    }
  }

  std::pmr::vector<std::byte> bytes_;
};

/// Whether records get a few bytes more than they need, which readers have to skip: only the
/// conformance suite wants this. Message, Chunk, DataEnd and Footer are never padded.
enum class Padding { kNone, kThreeBytes };

void encode(ByteBuffer& out, const Header& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const Schema& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const Channel& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, std::uint16_t channel_id, std::span<const MessageIndexEntry> entries,
            Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const ChunkIndex& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const Attachment& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const AttachmentIndex& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const Statistics& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const Metadata& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const MetadataIndex& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const SummaryOffset& record, Padding padding = Padding::kNone);
void encode(ByteBuffer& out, const Message& record);
void encode(ByteBuffer& out, const DataEnd& record);
void encode(ByteBuffer& out, const Footer& record);
/// All of a Chunk record but its `records`, which the caller writes behind it: they are large.
void encode_before_records(ByteBuffer& out, const Chunk& record);

}  // namespace coop::mcap
