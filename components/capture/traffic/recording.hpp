#pragma once
#include <atomic>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/mcap/writer.hpp"
#include "capture/traffic/offered_qos.hpp"
#include "core/time.hpp"

namespace coop::capture {

/// Where a capture goes and how.
struct RecordingOptions {
  std::filesystem::path path;  ///< of the file; with a ring: not used before save()
  Duration last{0};            ///< ring: that much is kept, in memory; 0: everything, into files
  /// Where rings lie that outlive their recorder (mcap/ring_folder.hpp): memory of the system.
  /// Empty: the ring dies with it. What is left of one becomes NAME-killed.mcap beside `path`.
  std::filesystem::path rings;
  std::size_t ring_bytes = std::size_t{512} << 20U;
  std::uint64_t split_bytes = 0;  ///< 0: one file
  Duration split_time{0};         ///< of log time; 0: one file
  mcap::WriterOptions writer;
};

/// A writer of a topic, as it is found. Each has a channel of its own, as bags of ROS 1 have
/// connections: so latched topics of several writers can be played as they were, and what one
/// component wrote can be left out.
struct WriterInfo {
  std::string topic;     ///< as shown, "/scan"
  std::string dds_type;  ///< on the wire
  bool keyed = false;
  OfferedQos qos;
  std::string component;  ///< name of its program
  std::string id;         ///< of the writer, as in Sample::writer
};

/// What a capture has and lacks of one topic.
struct TopicReport {
  std::string topic;
  std::uint64_t messages = 0;  ///< taken
  std::uint64_t missed = 0;    ///< numbers of their writers that never arrived
  std::uint64_t refused = 0;   ///< arrived, but the disk or the memory could not take them
};

/// Takes samples from any thread into an MCAP file, or into a ring that is written out on demand,
/// and keeps account of what is missing.
class Recording {
 public:
  /// Throws std::system_error where the file cannot be created.
  explicit Recording(const RecordingOptions& options);

  /// The channel of a writer, with the message definition of its type where that is known.
  std::uint16_t add_channel(const WriterInfo& writer);
  /// False where it could not be taken. `sequence`: of its writer.
  bool write(std::uint16_t channel, std::uint64_t sequence, Time log_time, Time publish_time,
             std::span<const std::uint8_t> bytes);

  void attach(const std::string& name, const std::string& media_type, std::string_view data,
              Time now);
  void note(const std::string& name, const std::map<std::string, std::string>& facts);
  /// The clock was set back: what comes now goes into a file of this name; a ring begins anew.
  /// Writers' last words on latched topics are said again in it.
  void begin_anew(const std::filesystem::path& path);
  /// Now and then: what is old enough goes to the disk.
  void tick(Time now);
  /// The ring to a file, with the last words on latched topics that are older than it, dated to its
  /// begin; the number of messages, or what went wrong.
  [[nodiscard]] std::future<std::uint64_t> save(const std::filesystem::path& path);
  [[nodiscard]] bool is_ring() const { return options_.last > Duration{0}; }

  /// Writes what is missing into the file and finishes it.
  void close();
  [[nodiscard]] mcap::WriterStatus status() const { return writer_->status(); }
  /// By topic, in alphabetical order.
  [[nodiscard]] std::vector<TopicReport> report() const;

 private:
  /// The last word of a writer on a latched topic.
  struct LastWord {
    std::uint64_t sequence = 0;
    Time log_time{};  ///< 0: not since the time began anew
    Time publish_time{};
    std::vector<std::uint8_t> bytes;
  };
  struct Account {
    std::string topic;
    std::string component;
    bool is_latched = false;
    std::optional<LastWord> last_word{};
    std::uint64_t last = 0;  ///< number of the last sample
    std::uint64_t messages = 0;
    std::uint64_t missed = 0;
    std::uint64_t refused = 0;
  };

  bool put(std::uint16_t channel, std::uint64_t sequence, Time log_time, Time publish_time,
           std::span<const std::uint8_t> bytes);
  /// Last words from before that time, as if they were said at it.
  void repeat_last_words(Time begin);

  [[nodiscard]] std::vector<mcap::StoredMessage> said_before(Time begin) const;
  [[nodiscard]] mcap::Ring ring() const;
  [[nodiscard]] std::unique_ptr<mcap::Writer> make_writer() const;

  RecordingOptions options_;
  mutable std::mutex mutex_;
  std::map<std::uint16_t, Account> accounts_;
  Time begin_{};   ///< log time of the first message, since it began anew
  Time newest_{};  ///< likewise of the last
  bool closed_ = false;
  std::unique_ptr<mcap::Writer> writer_;  ///< last: its thread asks for last words
};

/// "3 missed and 1 refused of /scan, 2 missed of /tf", or empty where nothing is missing.
[[nodiscard]] std::string losses_text(const std::vector<TopicReport>& report);

}  // namespace coop::capture
