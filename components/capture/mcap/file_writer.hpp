#pragma once
#include <memory>
#include <set>

#include "capture/mcap/chunk_builder.hpp"
#include "capture/mcap/crc.hpp"
#include "capture/mcap/sink.hpp"

namespace coop::mcap {

/// What a file has beside its data. A capture has all of it; the conformance suite takes any
/// combination.
struct Layout {
  bool message_index = true;
  bool chunk_index = true;
  bool attachment_index = true;
  bool metadata_index = true;
  bool statistics = true;
  bool repeated_schemas = true;
  bool repeated_channels = true;
  bool summary_offsets = true;
  /// CRC over the whole data section: one more pass over every byte.
  bool data_crc = true;
  Padding padding = Padding::kNone;
};

/// Lays out one file, in the order of the calls: the data section, then with finish() the summary.
/// What belongs together (a chunk with its indexes) goes out in one write, so that a process that
/// is killed leaves whole chunks. No thread, no clock. Any call throws std::system_error where the
/// sink does; finish() may still be called then and makes a complete file of what is there.
class FileWriter {
 public:
  FileWriter(std::unique_ptr<Sink> sink, const Header& header, const Layout& layout = {});

  /// Into the data section. A schema or channel that is there with the same id is not repeated.
  void add(const Schema& schema);
  void add(const Channel& channel);
  /// Outside of any chunk: such messages have no index.
  void add(const Message& message);
  void add(const Attachment& attachment);
  void add(const Metadata& metadata);
  /// `before`: schemas and channels to be written in front of the chunk where they are not there
  /// yet, with the same write.
  void add(const ReadyChunk& chunk, std::span<const Schema* const> schemas_before = {},
           std::span<const Channel* const> channels_before = {});
  /// That a chunk to be added holds these records itself: they count, and are repeated in the
  /// summary.
  void note_in_chunk(const Schema& schema) { note(schema); }
  void note_in_chunk(const Channel& channel) { note(channel); }

  /// DataEnd, summary, Footer. Nothing may be added after it.
  void finish();
  [[nodiscard]] bool finished() const { return finished_; }
  void sync() { sink_->sync(); }

  /// Bytes so far.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] bool has_channel(std::uint16_t id) const { return channel_ids_.contains(id); }
  [[nodiscard]] bool has_schema(std::uint16_t id) const { return schema_ids_.contains(id); }
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }

 private:
  bool note(const Schema& schema);
  bool note(const Channel& channel);
  void count(std::uint16_t channel, std::uint64_t messages, Nanoseconds start, Nanoseconds end);
  void write(std::span<const Bytes> parts);
  void write_buffer();
  [[nodiscard]] Footer encode_summary(std::uint64_t begin);

  std::unique_ptr<Sink> sink_;
  Layout layout_;
  std::uint64_t size_ = 0;
  Crc32 data_crc_;
  bool finished_ = false;
  ByteBuffer buffer_;
  ByteBuffer indexes_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::set<std::uint16_t> schema_ids_;
  std::set<std::uint16_t> channel_ids_;
  std::vector<ChunkIndex> chunk_indexes_;
  std::vector<AttachmentIndex> attachment_indexes_;
  std::vector<MetadataIndex> metadata_indexes_;
  Statistics statistics_;
};

}  // namespace coop::mcap
