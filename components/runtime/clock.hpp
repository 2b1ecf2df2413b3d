#pragma once
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "core/time.hpp"

namespace coop::runtime {

/// The only source of time of a component.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual Time now() const = 0;
  /// True where time passes by itself, so that waiting for a point in time makes sense.
  [[nodiscard]] virtual bool is_system() const = 0;
};

class SystemClock : public Clock {
 public:
  [[nodiscard]] Time now() const override {
    return Time(
        std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()));
  }
  [[nodiscard]] bool is_system() const override { return true; }
};

/// Notices that somebody has set the system's clock, by a clock that nobody can set.
class ClockSettings {
 public:
  using Steady = std::chrono::steady_clock::time_point;

  /// By how much the system's clock was set since the call before; zero where it only ran on, up to
  /// what adjusting its rate makes of it.
  [[nodiscard]] Duration change(Time system, Steady steady) {
    const Duration offset =
        system.time_since_epoch() - std::chrono::duration_cast<Duration>(steady.time_since_epoch());
    const Duration change = offset - std::exchange(offset_, offset).value_or(offset);
    return std::chrono::abs(change) < kTolerance ? Duration{0} : change;
  }

 private:
  static constexpr Duration kTolerance = std::chrono::milliseconds(50);
  std::optional<Duration> offset_;
};

/// Set from outside: by the /clock topic, or by a test. Time{} until it was first set.
class ManualClock : public Clock {
 public:
  [[nodiscard]] Time now() const override { return Time(Duration(nanoseconds_.load())); }
  [[nodiscard]] bool is_system() const override { return false; }
  void set(Time time) { nanoseconds_.store(to_nanoseconds(time)); }

 private:
  std::atomic<std::int64_t> nanoseconds_{0};
};

}  // namespace coop::runtime
