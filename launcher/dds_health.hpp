#pragma once
#include <memory>
#include <optional>
#include <string>

#include "launcher/health.hpp"

namespace coop::runtime {
class Transport;
}

namespace coop::launcher {

/// Heartbeats from the topic component_status.
class DdsHealth : public HealthSource {
 public:
  explicit DdsHealth(runtime::Transport& transport);
  ~DdsHealth() override;
  [[nodiscard]] int wake_fd() const override;
  [[nodiscard]] std::vector<Heartbeat> take() override;
  [[nodiscard]] std::optional<std::string> mended() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How the mission ended, from the topic mission_status.
struct MissionEnd {
  bool success = false;
  std::string detail;
};

class MissionWatch {
 public:
  explicit MissionWatch(runtime::Transport& transport);
  ~MissionWatch();
  /// Readable when there is news.
  [[nodiscard]] int wake_fd() const;
  /// Nothing while the mission goes on.
  [[nodiscard]] std::optional<MissionEnd> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace coop::launcher
