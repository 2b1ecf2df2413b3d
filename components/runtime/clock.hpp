#pragma once
#include <atomic>
#include <memory>

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
