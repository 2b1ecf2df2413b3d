#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace coop::launcher {

/// Time for the launcher's own deadlines; independent of the robot's clock and of changes of the
/// system time.
using Instant = std::chrono::steady_clock::time_point;

/// What a component says of itself.
enum class Health { kStarting, kReady, kDegraded, kStopping, kFinished };

struct Heartbeat {
  std::string component;
  Health health = Health::kStarting;
  std::string detail;
  pid_t pid = 0;
  std::string host;
};

/// Where heartbeats come from: the topic component_status, or a test.
class HealthSource {
 public:
  virtual ~HealthSource() = default;
  /// Readable when heartbeats have arrived.
  [[nodiscard]] virtual int wake_fd() const = 0;
  /// What has arrived since the last call, oldest first.
  [[nodiscard]] virtual std::vector<Heartbeat> take() = 0;
  /// What was amiss with listening and take() has mended, since the last call; for people.
  [[nodiscard]] virtual std::optional<std::string> mended() { return std::nullopt; }
};

}  // namespace coop::launcher
