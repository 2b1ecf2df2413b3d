#pragma once
#include <filesystem>
#include <functional>
#include <memory>

#include "capture/mcap/definitions.hpp"
#include "capture/mcap/file_writer.hpp"

namespace coop::mcap {

enum class Sync {
  kNever,  // the system writes when it likes: a killed process loses nothing, a power cut seconds
  kEachFile,   // when a file is finished
  kEachChunk,  // after each chunk: a power cut loses the last one
};

/// How files of a capture are made.
struct FileOptions {
  Header header{"ros2", "coop"};
  Layout layout;
  Sync sync = Sync::kNever;
  std::uint64_t reserve = 0;  ///< see create_file()
};

/// Whether an attachment or metadata is in each file of a series, or only in the one being written.
enum class Where { kThisFile, kEveryFile };

struct StoredAttachment {
  Attachment attachment;  // a view of `data`
  std::vector<std::byte> data;
};

struct StoredMessage {
  StoredMessage(const Message& said, Bytes bytes)
      : data(bytes.begin(), bytes.end()), message(said) {
    message.data = data;
  }
  StoredMessage(StoredMessage&&) = default;
  std::vector<std::byte> data;
  Message message;  // a view of `data`
};

/// Where a writer's chunks go. One thread calls; what throws (std::system_error) left the target as
/// it was, or in a state where all further calls throw the same.
class ChunkTarget {
 public:
  virtual ~ChunkTarget() = default;
  virtual void add(const ReadyChunk& chunk) = 0;
  virtual void add(std::shared_ptr<const StoredAttachment> attachment, Where where) = 0;
  virtual void add(const Metadata& metadata, Where where) = 0;
  /// What is kept in memory, as a complete file. Throws std::logic_error where nothing is.
  virtual std::uint64_t write_snapshot(const std::filesystem::path& path) = 0;
  /// A new time begins: a series goes on in a file of this name, a ring forgets what it holds.
  virtual void begin_anew(const std::filesystem::path& path) = 0;
  virtual void finish() = 0;
  /// The files written or begun, and how long they are together.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
  /// What is not as it should be although nothing is lost; empty: nothing.
  [[nodiscard]] virtual const std::string& warning() const {
    static const std::string none;
    return none;
  }

 protected:
  std::vector<std::filesystem::path> files_;
};

/// Files one after the other.
struct Series {
  /// NAME.mcap; where it is split: NAME_0001.mcap, NAME_0002.mcap, ...
  std::filesystem::path path;
  std::uint64_t split_bytes = 0;   // 0: no limit
  Nanoseconds split_duration = 0;  // of log time; 0: no limit
};
[[nodiscard]] std::unique_ptr<ChunkTarget> make_series(const Series& series,
                                                       const FileOptions& options,
                                                       const Definitions& definitions);

/// The last chunks, in memory.
struct Ring {
  Nanoseconds duration = 0;   // of log time
  std::size_t max_bytes = 0;  // as compressed
  /// A folder to be made for them, so that they outlive the process; gone when the ring is closed
  /// (ring_folder.hpp). Where it fails they are in the memory of the process, and warning() says
  /// so. Empty: always there.
  std::filesystem::path folder{};
  std::filesystem::path origin{};  // the capture that is to be made of it then; absolute
  /// What was said last before that time and still holds, dated to it. Of the writer's thread.
  std::function<std::vector<StoredMessage>(Nanoseconds begin)> said_before{};
};
[[nodiscard]] std::unique_ptr<ChunkTarget> make_ring(const Ring& ring, const FileOptions& options,
                                                     const Definitions& definitions);

}  // namespace coop::mcap
