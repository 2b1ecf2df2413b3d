#pragma once
#include <atomic>
#include <condition_variable>
#include <future>
#include <thread>

#include "capture/mcap/chunk_target.hpp"

namespace coop::mcap {

enum class WhenFull {
  kLose,  // a message that finds no room is counted as lost: capturing never holds up the robot
  kWait,  // write() waits: for programs that copy files
};

struct WriterOptions {
  FileOptions file;
  Compression compression = Compression::kZstd;
  int level = 1;                                      // see Compressor
  std::size_t chunk_bytes = std::size_t{4} << 20U;    // a chunk is closed before it grows beyond
  Nanoseconds chunk_age = 1'000'000'000;              // ... or is older than this, in log time
  std::size_t queue_bytes = std::size_t{256} << 20U;  // memory for chunks on their way to the disk
  WhenFull when_full = WhenFull::kLose;
  /// What is in memory survives the death of the process, in CAPTURE.tail, or in the ring's folder.
  bool tail = false;
};

struct WriterStatus {
  std::uint64_t messages = 0;                            // taken
  std::map<std::uint16_t, std::uint64_t> lost_messages;  // by channel
  std::uint64_t bytes = 0;                               // of all files so far, or of the ring
  std::vector<std::filesystem::path> files;
  std::string error;    // the first failure of the disk; empty: none
  std::string warning;  // of a ring that would not survive the process now; empty: none

  [[nodiscard]] std::uint64_t lost() const;
};

/// Writes captures. write() copies the message into the chunk being filled and returns: a thread of
/// the writer's own compresses finished chunks and writes each with one write, in the order they
/// were finished. All calls may come from any thread; no clock is read, time is the messages' log
/// time and what close_aged_chunk() is told.
///
/// A process killed at any moment leaves all chunks written before, and with `tail` those that are
/// being filled and wait too. When the disk fails, the file ends with the last whole chunk,
/// status().error says why, and what comes later is counted as lost.
class Writer {
 public:
  /// Throws std::system_error where the file cannot be created.
  Writer(const Series& series, const WriterOptions& options = {});
  /// In memory, for snapshot().
  Writer(const Ring& ring, const WriterOptions& options = {});
  /// Closes; errors are then only in the file's end.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// See Definitions.
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t add_channel(std::uint16_t schema_id, std::string_view topic,
                            std::string_view message_encoding = "cdr",
                            const std::map<std::string, std::string>& metadata = {});

  /// False where the message is lost (counted in status()). The channel has to be one of
  /// add_channel()'s. Does not allocate once the buffers are as large as they get.
  bool write(const Message& message);
  /// The chunk being filled goes to the disk if its oldest message is older than chunk_age: for
  /// times when nothing arrives.
  void close_aged_chunk(Nanoseconds now);

  /// In the file being written, or in all (those before are finished and stay as they are). Copies.
  void attach(const Attachment& attachment, Where where = Where::kEveryFile);
  void add(const Metadata& metadata, Where where = Where::kEveryFile);

  /// The time of the messages begins anew, earlier than it was: what comes now goes into a file of
  /// this name (its parts, where files are split), and a ring keeps nothing of what was before.
  void begin_anew(const std::filesystem::path& path);

  /// Waits until everything written so far has been given to the system.
  void flush();
  /// Writes what the ring holds, and what is being filled, to a complete file; the ring keeps it.
  /// The future has the number of messages, or the error (std::system_error; std::logic_error for
  /// a writer into files).
  [[nodiscard]] std::future<std::uint64_t> snapshot(const std::filesystem::path& path);

  /// Finishes the files; further messages are lost. Once is enough.
  void close();
  [[nodiscard]] WriterStatus status() const;

 private:
  /// A finished chunk, or something else to be done in its turn.
  struct Job {
    std::unique_ptr<ChunkBuilder> chunk;
    std::function<void()> command;
  };

  void start();
  void run();
  void run_chunk(std::unique_ptr<ChunkBuilder> chunk);
  void post(std::function<void()> command);
  void collect_definitions();
  [[nodiscard]] bool make_room(std::unique_lock<std::mutex>& lock, const Message& message);
  [[nodiscard]] bool take_builder(std::size_t capacity);
  void drop_smallest();
  void hand_over();
  void note_failure(const std::string& what);

  WriterOptions options_;
  Definitions definitions_;
  std::atomic<bool> has_new_definitions_{false};
  std::size_t schemas_told_ = 0;  // to the builders: a tail explains itself
  std::size_t channels_told_ = 0;
  ByteBuffer untold_;                    // those that come with the next message
  std::unique_ptr<ChunkTarget> target_;  // of the thread
  std::unique_ptr<Tail> tail_;
  bool is_ring_ = false;
  Compressor compressor_;  // of the thread
  ByteBuffer compressed_;  // of the thread

  mutable std::mutex mutex_;
  std::condition_variable has_job_;
  std::condition_variable has_room_;
  std::deque<Job> jobs_;
  std::unique_ptr<ChunkBuilder> current_;
  std::vector<std::unique_ptr<ChunkBuilder>> free_;
  std::size_t builders_ = 0;       // current, queued, being written and free
  std::size_t builder_bytes_ = 0;  // what they hold
  bool closed_ = false;
  bool failed_ = false;
  WriterStatus status_;
  std::thread thread_;
};

}  // namespace coop::mcap
