#include "launcher/service_notifier.hpp"

#include <systemd/sd-daemon.h>

namespace coop::launcher {

ServiceNotifier::ServiceNotifier(Instant now) : next_(now), last_up_(now) {
  std::uint64_t limit = 0;
  // Three times within the limit, so that a busy machine is not taken for a dead launcher.
  if (sd_watchdog_enabled(0, &limit) > 0) period_ = std::chrono::microseconds(limit / 3);
}

void ServiceNotifier::tick(bool required_are_up, Instant now) {
  if (required_are_up && !is_ready_) {
    is_ready_ = true;
    sd_notify(0, "READY=1\nSTATUS=all required components are up");
  }
  if (required_are_up || !is_ready_ || is_stopping_) last_up_ = now;
  if (!period_ || now < next_ || now - last_up_ > kPatience) return;
  sd_notify(0, "WATCHDOG=1");
  next_ = now + *period_;
}

void ServiceNotifier::stopping() {
  if (is_stopping_) return;
  is_stopping_ = true;
  sd_notify(0, "STOPPING=1");
}

}  // namespace coop::launcher
