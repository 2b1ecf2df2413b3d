#pragma once
#include "capture/mcap/chunk_target.hpp"
#include "capture/mcap/source.hpp"

namespace coop::mcap {

/// What a ring holds, in a folder that outlives the process: in memory where the folder is
/// (/dev/shm). In it are
///   origin     where the capture belongs; locked by the process as long as it lives
///   begin.mcap attachments and metadata
///   NNNN.mcap  an eighth of the ring each, from the oldest on: definitions, what was said last on
///              latched topics before it began, chunks; a capture without an end
///   ring.mcap.tail  chunks in making (tail.hpp)
/// All calls but the destructor throw std::system_error where the disk fails.
class RingFolder {
 public:
  struct Segment;
  /// Where a chunk lies. The file goes with the last chunk that is in it.
  struct Place {
    std::shared_ptr<Segment> segment;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
  };
  /// A chunk read back.
  struct ReadChunk {
    std::vector<std::byte> bytes;
    Chunk chunk;  ///< a view of `bytes`
    std::vector<ChannelEntries> channels;
  };

  RingFolder(const Ring& ring, const FileOptions& options, const Definitions& definitions);
  /// Nothing is left of it.
  ~RingFolder();
  RingFolder(const RingFolder&) = delete;
  RingFolder& operator=(const RingFolder&) = delete;

  void add(const Attachment& attachment) { begin_->add(attachment); }
  void add(const Metadata& metadata) { begin_->add(metadata); }
  [[nodiscard]] Place add(const ReadyChunk& chunk);
  [[nodiscard]] static ReadChunk read(const Place& place);
  /// What comes next goes into a file of its own.
  void end_segment() { segment_.reset(); }

  static constexpr const char* kPrefix = "coop-ring-";
  static constexpr const char* kOrigin = "origin";
  static constexpr const char* kBegin = "begin.mcap";
  /// As if it were a capture: its tail is in the folder.
  static constexpr const char* kTailOf = "ring.mcap";
  static constexpr std::uint64_t kSegments = 8;

 private:
  [[nodiscard]] bool is_full_for(const ReadyChunk& chunk) const;
  void begin_segment(Nanoseconds time);

  Ring ring_;
  FileOptions options_;
  const Definitions& definitions_;
  int lock_ = -1;
  std::unique_ptr<FileWriter> begin_;
  std::shared_ptr<Segment> segment_;
  std::size_t segments_ = 0;
  std::size_t schemas_ = 0;  // of the definitions, in this segment
  std::size_t channels_ = 0;
};

}  // namespace coop::mcap
