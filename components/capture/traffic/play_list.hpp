#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/mcap/reader.hpp"
#include "capture/traffic/offered_qos.hpp"
#include "capture/traffic/topic_names.hpp"
#include "core/time.hpp"

namespace coop::capture {

/// What of a capture is played.
struct PlaySelection {
  TopicSelection topics{};
  /// Components whose messages are left out: those that run live.
  std::vector<std::string> without{};
  /// "/scan:=/scan_recorded"
  std::vector<std::string> remap{};
  double start = 0.0;     ///< s into the capture
  double duration = 0.0;  ///< s of the capture; 0: to its end

  /// Throws std::invalid_argument.
  void validate() const;
};

/// A channel of a capture as it is to be published.
struct PlayChannel {
  std::string topic;  ///< shown, remapped
  std::string recorded_topic;
  std::string dds_type;
  bool keyed = false;
  OfferedQos qos;
  std::string component;  ///< that wrote it; empty where the capture does not tell
  std::string writer;     ///< id, likewise
};

struct PlayMessage {
  std::size_t channel = 0;
  std::uint64_t sequence = 0;
  Time log_time{};
  std::vector<std::uint8_t> bytes;
};

/// The messages of one or more files (the parts of a split capture) in the order in which they were
/// recorded.
class PlayList {
 public:
  /// A file, or a folder: all captures in it, by name. Throws what the reader throws, and
  /// std::invalid_argument where nothing is left to be played.
  PlayList(const std::filesystem::path& path, const PlaySelection& selection);

  [[nodiscard]] const std::vector<PlayChannel>& channels() const { return channels_; }
  /// Log times of the first and the last message of the files, and what is played of them.
  [[nodiscard]] Time begin() const { return begin_; }
  [[nodiscard]] Time end() const { return end_; }
  /// What a reader would have found when the playing begins: of each latched channel the last
  /// message before (of keyed ones all of them, in order).
  [[nodiscard]] std::vector<PlayMessage> latched_before();
  /// The next message; nothing at the end.
  [[nodiscard]] std::optional<PlayMessage> next();
  void rewind();

  /// All messages of a topic, by its recorded name, whether selected or not.
  [[nodiscard]] std::vector<PlayMessage> all_of(const std::string& recorded_topic_pattern);
  [[nodiscard]] bool was_cut() const { return was_cut_; }

 private:
  struct File {
    std::unique_ptr<mcap::Reader> reader;
    std::map<std::uint16_t, std::size_t> channels;  ///< by id, those that are played
  };
  void add_channels(File& file, const PlaySelection& selection);
  void set_range(const PlaySelection& selection);
  [[nodiscard]] static PlayMessage copy(const mcap::ReadMessage& message, std::size_t channel);

  std::vector<File> files_;
  std::vector<PlayChannel> channels_;
  Time begin_{};
  Time end_{};
  std::size_t file_ = 0;
  std::optional<mcap::MessageCursor> cursor_;
  bool was_cut_ = false;
};

}  // namespace coop::capture
