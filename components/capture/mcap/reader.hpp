#pragma once
#include <functional>
#include <limits>
#include <queue>

#include "capture/mcap/compression.hpp"
#include "capture/mcap/summary.hpp"

namespace coop::mcap {

enum class Order {
  kLogTime,  // by log time; messages of one time in the order of the file
  kFile,     // as recorded
};

/// Which messages are read.
struct Selection {
  Nanoseconds start = 0;                                      // log time, from here on
  Nanoseconds end = std::numeric_limits<Nanoseconds>::max();  // before this; the default: all
  std::vector<std::string> topics{};                          // empty: all
  Order order = Order::kLogTime;

  [[nodiscard]] bool has(Nanoseconds time) const {
    return time >= start && (time < end || end == std::numeric_limits<Nanoseconds>::max());
  }
};

/// A message with what it is of. The data is valid until the cursor's next call; channel and
/// schema as long as the reader or a cursor of it lives.
struct ReadMessage {
  const Channel* channel = nullptr;
  const Schema* schema = nullptr;  // null: the channel has none
  Message message;
};

struct ReaderState;

/// Messages one after the other. Holds the chunks that overlap in time, up to
/// ReadLimits::chunk_cache; beyond it chunks are uncompressed again when their turn comes.
class MessageCursor {
 public:
  MessageCursor(std::shared_ptr<ReaderState> state, Selection selection);
  ~MessageCursor();
  MessageCursor(MessageCursor&&) noexcept;
  MessageCursor& operator=(MessageCursor&&) noexcept;

  /// Nothing at the end. Throws FileError for what is damaged.
  std::optional<ReadMessage> next();

 private:
  class Merge;
  std::unique_ptr<Merge> merge_;
};

struct OwnedAttachment {
  Attachment attachment;  // its data is a view of `record`
  std::vector<std::byte> record;
};

/// Reads a file by its index. A file without one (cut, its writer killed, or written without) is
/// scanned once instead and then read the same way; summary().defect tells. Not for two threads
/// at a time. All errors name the file: FileError (damaged), std::system_error (cannot be read).
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path, const ReadLimits& limits = {});
  explicit Reader(std::shared_ptr<const Source> source, const ReadLimits& limits = {});

  [[nodiscard]] const Summary& summary() const;
  [[nodiscard]] const Source& source() const;
  /// Any number of cursors may be open at a time.
  [[nodiscard]] MessageCursor messages(const Selection& selection = {});
  [[nodiscard]] OwnedAttachment attachment(const AttachmentIndex& index) const;
  [[nodiscard]] Metadata metadata(const MetadataIndex& index) const;

 private:
  std::shared_ptr<ReaderState> state_;
};

}  // namespace coop::mcap
