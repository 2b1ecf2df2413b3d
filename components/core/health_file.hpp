#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coop {

/// What a component last wrote of itself.
struct HealthNote {
  std::string state;       ///< starting, ready, degraded, stopping, finished
  std::string reason;      ///< one line
  pid_t pid = 0;           ///< of the writer
  std::int64_t stamp = 0;  ///< ns of CLOCK_BOOTTIME: no change of the system time moves it
};

/// The file `DOMAIN[-ROBOT].NAME.state` in a runtime folder, which a component replaces at each
/// heartbeat and takes away at its end. Trouble in writing (disk full, no folder) never reaches the
/// component: the file grows old, and `coop health` says so.
class HealthFile {
 public:
  HealthFile(const std::string& robot, int domain, const std::string& component);
  ~HealthFile();
  HealthFile(const HealthFile&) = delete;
  HealthFile& operator=(const HealthFile&) = delete;

  void write(std::string_view state, std::string_view reason) noexcept;
  /// Why there is no file, one line; empty where all is well.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  std::filesystem::path path_;
  std::string problem_;
};

/// Nothing for a text that is no such note.
[[nodiscard]] std::optional<HealthNote> parse_health_note(std::string_view text);

/// One component found in the runtime folders.
struct FoundHealth {
  std::string system;  ///< DOMAIN or DOMAIN-ROBOT
  std::string component;
  HealthNote note;
};

/// Those of the systems named; without domain or robot, of all. Sorted by system and component.
[[nodiscard]] std::vector<FoundHealth> find_health(std::optional<int> domain,
                                                   const std::optional<std::string>& robot);

enum class Liveness { kReady, kDegraded, kStarting, kStopping, kStale, kAbsent };
[[nodiscard]] std::string_view to_string(Liveness liveness);

/// A component beats every 0.5 s; one that has been silent for longer than this is stopped or
/// stuck.
inline constexpr std::int64_t kHealthStaleAfter = 1'300'000'000;  // ns

/// What a note says at `now` (ns of CLOCK_BOOTTIME). `writer_lives`: a process of its pid exists.
[[nodiscard]] Liveness judge_health(const HealthNote& note, std::int64_t now, bool writer_lives);

/// ns of CLOCK_BOOTTIME
[[nodiscard]] std::int64_t boot_time();

}  // namespace coop
