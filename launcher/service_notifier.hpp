#pragma once
#include <chrono>
#include <optional>

#include "launcher/health.hpp"

namespace coop::launcher {

/// Tells systemd how the system is (Type=notify, WatchdogSec=); silent where the launcher is no
/// service. It is ready when every required component is up for the first time. From then on the
/// watchdog is fed while the caller's loop turns and no required component has been missing for
/// longer than kPatience: a robot that single restarts do not bring back is started anew as a
/// whole.
class ServiceNotifier {
 public:
  static constexpr std::chrono::seconds kPatience{60};

  /// Reads WATCHDOG_USEC and NOTIFY_SOCKET from the environment.
  explicit ServiceNotifier(Instant now);

  /// Twice a second or more often. `required_are_up`: see Supervisor.
  void tick(bool required_are_up, Instant now);
  void stopping();

 private:
  std::optional<std::chrono::microseconds> period_;
  Instant next_;
  Instant last_up_;
  bool is_ready_ = false;
  bool is_stopping_ = false;
};

}  // namespace coop::launcher
