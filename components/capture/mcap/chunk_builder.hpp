#pragma once
#include <optional>

#include "capture/mcap/compression.hpp"
#include "capture/mcap/encode.hpp"
#include "capture/mcap/tail.hpp"

namespace coop::mcap {

/// The messages of one channel in a chunk.
struct ChannelEntries {
  std::uint16_t channel_id = 0;
  std::vector<MessageIndexEntry> entries;  // in the order of recording
};

/// A chunk being filled: records one after the other, and where each channel's messages are.
/// After clear() it is filled again without allocating.
class ChunkBuilder {
 public:
  /// `slot`: where the records lie, as long as it has room for them; none: on the heap.
  /// reserve() as much as it has, before anything is added.
  explicit ChunkBuilder(Padding padding = Padding::kNone, std::unique_ptr<Tail::Slot> slot = {})
      : padding_(padding),
        slot_(std::move(slot)),
        records_(slot_ ? slot_.get() : std::pmr::new_delete_resource()) {}

  void add(const Schema& schema) { encode(records_, schema, padding_); }
  void add(const Channel& channel) { encode(records_, channel, padding_); }
  void add(const Message& message);
  /// Schemas and channels, encoded.
  void add_records(Bytes records) { records_.raw(records); }
  void clear();
  void reserve(std::size_t size) { records_.reserve(size); }

  [[nodiscard]] Bytes records() const { return records_.view(); }
  [[nodiscard]] std::size_t size() const { return records_.size(); }
  /// Memory held, bytes.
  [[nodiscard]] std::size_t capacity() const { return records_.capacity(); }
  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] std::uint64_t message_count() const { return message_count_; }
  /// Earliest and latest log time; 0 without messages.
  [[nodiscard]] Nanoseconds start_time() const { return start_time_; }
  [[nodiscard]] Nanoseconds end_time() const { return end_time_; }
  /// Channels with messages in this chunk, in the order of their first one.
  [[nodiscard]] std::span<const ChannelEntries> channels() const {
    return std::span(channels_).first(channels_used_);
  }

 private:
  std::vector<MessageIndexEntry>& entries_of(std::uint16_t channel);

  Padding padding_;
  std::unique_ptr<Tail::Slot> slot_;
  ByteBuffer records_;
  std::uint64_t message_count_ = 0;
  Nanoseconds start_time_ = 0;
  Nanoseconds end_time_ = 0;
  std::vector<ChannelEntries> channels_;  // those in use first; the others keep their memory
  std::size_t channels_used_ = 0;
  std::vector<std::uint32_t> slot_of_channel_;  // index into channels_ plus 1; 0: none
};

/// A chunk ready for a file or for the ring: its header's values, and its records as they will
/// lie in the file. Spans view the builder and the compressor's buffer, or a StoredChunk.
struct ReadyChunk {
  Chunk chunk;
  std::span<const ChannelEntries> channels;
};

/// Compresses what the builder holds; `checksum`: with the CRC of the records.
[[nodiscard]] ReadyChunk make_ready(const ChunkBuilder& builder, Compressor& compressor,
                                    ByteBuffer& buffer, bool checksum = true);

}  // namespace coop::mcap
