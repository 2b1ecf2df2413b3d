#include <algorithm>
#include <deque>

#include "capture/mcap/chunk_target.hpp"

namespace coop::mcap {
namespace {

/// A chunk with memory of its own.
struct StoredChunk {
  explicit StoredChunk(const ReadyChunk& ready)
      : chunk(ready.chunk),
        records(ready.chunk.records.begin(), ready.chunk.records.end()),
        channels(ready.channels.begin(), ready.channels.end()) {
    chunk.records = records;
  }
  StoredChunk(const StoredChunk&) = delete;
  StoredChunk& operator=(const StoredChunk&) = delete;

  [[nodiscard]] std::size_t size() const {
    std::size_t size = records.size();
    for (const ChannelEntries& channel : channels) {
      size += channel.entries.size() * sizeof(MessageIndexEntry);
    }
    return size;
  }

  Chunk chunk;
  std::vector<std::byte> records;
  std::vector<ChannelEntries> channels;
};

class ChunkRing final : public ChunkTarget {
 public:
  ChunkRing(Ring ring, FileOptions options, const Definitions& definitions)
      : ring_(ring), options_(std::move(options)), definitions_(definitions) {}

  void add(const ReadyChunk& chunk) override {
    chunks_.emplace_back(chunk);
    bytes_ += chunks_.back().size();
    latest_ = std::max(latest_, chunk.chunk.message_end_time);
    while (chunks_.size() > 1 && (bytes_ > ring_.max_bytes || is_too_old(chunks_.front()))) {
      bytes_ -= chunks_.front().size();
      chunks_.pop_front();
    }
  }
  void add(std::shared_ptr<const StoredAttachment> attachment, Where) override {
    attachments_.push_back(std::move(attachment));
  }
  void add(const Metadata& metadata, Where) override { metadata_.push_back(metadata); }

  /// All of it or no file.
  std::uint64_t write_snapshot(const std::filesystem::path& path) override {
    try {
      return write_whole(path);
    } catch (...) {
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
      throw;
    }
  }

  void begin_anew(const std::filesystem::path&) override {
    chunks_.clear();
    bytes_ = 0;
    latest_ = 0;
  }

  void finish() override {}
  [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }

 private:
  std::uint64_t write_whole(const std::filesystem::path& path) {
    FileWriter file(create_file(path, options_.reserve), options_.header, options_.layout);
    for (const auto& attachment : attachments_) file.add(attachment->attachment);
    for (const Metadata& metadata : metadata_) file.add(metadata);
    const Definitions::View all = definitions_.after(0, 0);
    for (const Schema* schema : all.schemas) file.add(*schema);
    for (const Channel* channel : all.channels) file.add(*channel);
    for (const StoredChunk& chunk : chunks_) file.add(ReadyChunk{chunk.chunk, chunk.channels});
    file.finish();
    if (options_.sync != Sync::kNever) file.sync();
    files_.push_back(path);
    return file.statistics().message_count;
  }

  [[nodiscard]] bool is_too_old(const StoredChunk& chunk) const {
    return latest_ - chunk.chunk.message_end_time > ring_.duration;
  }

  Ring ring_;
  FileOptions options_;
  const Definitions& definitions_;
  std::deque<StoredChunk> chunks_;
  std::size_t bytes_ = 0;
  Nanoseconds latest_ = 0;
  std::vector<std::shared_ptr<const StoredAttachment>> attachments_;
  std::vector<Metadata> metadata_;
};

}  // namespace

std::unique_ptr<ChunkTarget> make_ring(const Ring& ring, const FileOptions& options,
                                       const Definitions& definitions) {
  return std::make_unique<ChunkRing>(ring, options, definitions);
}

}  // namespace coop::mcap
