#pragma once
#include <chrono>
#include <cstdint>

namespace coop {

/// Signed span of time, nanoseconds.
using Duration = std::chrono::nanoseconds;

/// Tag of the robot's time line: system time (UNIX epoch) or simulated time, whichever the
/// runtime's clock follows. It has no now(): algorithms are given the time, only the runtime reads
/// a clock.
struct RobotClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<RobotClock, Duration>;
  static constexpr bool is_steady = false;
};

/// Point on the robot's time line, nanoseconds since its epoch. Time{} means "never set".
using Time = RobotClock::time_point;

constexpr double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}
constexpr double to_seconds(Time time) {
  return to_seconds(time.time_since_epoch());
}

/// Rounds to the nearest nanosecond.
constexpr Duration seconds(double value) {
  return Duration(static_cast<std::int64_t>(value * 1e9 + (value < 0 ? -0.5 : 0.5)));
}
constexpr Time time_from_seconds(double value) {
  return Time(seconds(value));
}
constexpr std::int64_t to_nanoseconds(Time time) {
  return time.time_since_epoch().count();
}

}  // namespace coop
