#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sequencer/mission_state.hpp"

namespace coop::sequencer {

/// The mission on disk: a file of lines `checksum JSON`, each the whole state after one change,
/// appended and synced. What is at the end of the file and whole counts; a line cut short or
/// damaged is passed over, so that a process killed at any moment loses at most the change it was
/// writing, and that was not yet acted upon.
class Journal {
 public:
  /// Opens or creates. Throws std::system_error naming the file.
  explicit Journal(std::filesystem::path path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// False when the disk refuses (full): the caller must not act on the state. A later append may
  /// succeed.
  [[nodiscard]] bool append(const MissionState& state);

  /// The last whole state in the file, if any.
  [[nodiscard]] static std::optional<MissionState> read(const std::filesystem::path& path);
  /// The same of a file's content.
  [[nodiscard]] static std::optional<MissionState> last_state(std::string_view content);

 private:
  std::filesystem::path path_;
  int fd_ = -1;
};

[[nodiscard]] std::string to_line(const MissionState& state);
/// Nothing where the line is damaged.
[[nodiscard]] std::optional<MissionState> from_line(std::string_view line);

}  // namespace coop::sequencer
