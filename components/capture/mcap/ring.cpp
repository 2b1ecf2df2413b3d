#include <algorithm>
#include <deque>
#include <system_error>

#include "capture/mcap/ring_folder.hpp"

namespace coop::mcap {
namespace {

/// A chunk in the folder of the ring, or with memory of its own.
struct StoredChunk {
  std::size_t size = 0;
  Nanoseconds end_time = 0;
  RingFolder::Place place;
  RingFolder::ReadChunk in_memory;

  [[nodiscard]] bool is_in_folder() const { return place.segment != nullptr; }
};

StoredChunk copy_of(const ReadyChunk& ready) {
  StoredChunk stored;
  RingFolder::ReadChunk& copy = stored.in_memory;
  copy.chunk = ready.chunk;
  copy.bytes.assign(ready.chunk.records.begin(), ready.chunk.records.end());
  copy.chunk.records = copy.bytes;
  copy.channels.assign(ready.channels.begin(), ready.channels.end());
  stored.size = copy.bytes.size();
  for (const ChannelEntries& channel : copy.channels) {
    stored.size += channel.entries.size() * sizeof(MessageIndexEntry);
  }
  return stored;
}

class ChunkRing final : public ChunkTarget {
 public:
  ChunkRing(Ring ring, FileOptions options, const Definitions& definitions)
      : ring_(std::move(ring)), options_(std::move(options)), definitions_(definitions) {
    if (ring_.folder.empty()) return;
    try {
      folder_ = std::make_unique<RingFolder>(ring_, options_, definitions_);
    } catch (const std::system_error& error) {
      note(error);
    }
  }

  void add(const ReadyChunk& chunk) override {
    latest_ = std::max(latest_, chunk.chunk.message_end_time);
    chunks_.push_back(stored(chunk));
    bytes_ += chunks_.back().size;
    while (chunks_.size() > 1 && (bytes_ > ring_.max_bytes || is_too_old(chunks_.front()))) {
      bytes_ -= chunks_.front().size;
      chunks_.pop_front();
    }
  }
  void add(std::shared_ptr<const StoredAttachment> attachment, Where) override {
    in_folder([&] { folder_->add(attachment->attachment); });
    attachments_.push_back(std::move(attachment));
  }
  void add(const Metadata& metadata, Where) override {
    in_folder([&] { folder_->add(metadata); });
    metadata_.push_back(metadata);
  }

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
    if (folder_) folder_->end_segment();
    bytes_ = 0;
    latest_ = retry_ = 0;
  }

  void finish() override {
    chunks_.clear();
    folder_.reset();
  }
  [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }
  [[nodiscard]] const std::string& warning() const override { return warning_; }

 private:
  std::uint64_t write_whole(const std::filesystem::path& path) {
    FileWriter file(create_file(path, options_.reserve), options_.header, options_.layout);
    for (const auto& attachment : attachments_) file.add(attachment->attachment);
    for (const Metadata& metadata : metadata_) file.add(metadata);
    const Definitions::View all = definitions_.after(0, 0);
    for (const Schema* schema : all.schemas) file.add(*schema);
    for (const Channel* channel : all.channels) file.add(*channel);
    for (const StoredChunk& chunk : chunks_) {
      if (chunk.is_in_folder()) {
        const RingFolder::ReadChunk read = RingFolder::read(chunk.place);
        file.add(ReadyChunk{read.chunk, read.channels});
      } else {
        file.add(ReadyChunk{chunk.in_memory.chunk, chunk.in_memory.channels});
      }
    }
    file.finish();
    if (options_.sync != Sync::kNever) file.sync();
    files_.push_back(path);
    return file.statistics().message_count;
  }

  [[nodiscard]] bool is_too_old(const StoredChunk& chunk) const {
    return latest_ - chunk.end_time > ring_.duration;
  }

  /// In the folder, but where it fails: then in memory, until it is tried again.
  StoredChunk stored(const ReadyChunk& chunk) {
    StoredChunk result;
    const bool tries = folder_ && latest_ >= retry_;
    if (tries && in_folder([&] { result.place = folder_->add(chunk); })) {
      result.size = static_cast<std::size_t>(result.place.length);
      warning_.clear();
    } else {
      result = copy_of(chunk);
    }
    result.end_time = chunk.chunk.message_end_time;
    return result;
  }

  template <class Function>
  bool in_folder(const Function& function) {
    if (!folder_) return false;
    try {
      function();
      return true;
    } catch (const std::system_error& error) {
      note(error);
      folder_->end_segment();
      retry_ = latest_ + ring_.duration / RingFolder::kSegments;
      return false;
    }
  }
  void note(const std::system_error& error) {
    warning_ = std::string("the ring dies with this process: ") + error.what();
  }

  Ring ring_;
  FileOptions options_;
  const Definitions& definitions_;
  std::unique_ptr<RingFolder> folder_;
  std::deque<StoredChunk> chunks_;
  std::size_t bytes_ = 0;
  Nanoseconds latest_ = 0;
  Nanoseconds retry_ = 0;  ///< the folder failed: not before then again
  std::string warning_;
  std::vector<std::shared_ptr<const StoredAttachment>> attachments_;
  std::vector<Metadata> metadata_;
};

}  // namespace

std::unique_ptr<ChunkTarget> make_ring(const Ring& ring, const FileOptions& options,
                                       const Definitions& definitions) {
  return std::make_unique<ChunkRing>(ring, options, definitions);
}

}  // namespace coop::mcap
