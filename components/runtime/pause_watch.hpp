#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace coop::runtime {

/// Tells pauses of a process from its looks at the time, which are frequent while it runs. From any
/// thread.
class PauseDetector {
 public:
  /// Counts pauses that are longer than `limit`; `now`: the first look.
  PauseDetector(std::chrono::nanoseconds limit, std::chrono::nanoseconds now)
      : limit_(limit), last_look_(now) {}

  /// True when the look before was longer ago than the limit.
  bool look(std::chrono::nanoseconds now);
  /// The longest pause that has ended since the last call; nothing when there was none, or while
  /// less than `rest` has passed since the last one began.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> take(std::chrono::nanoseconds now,
                                                             std::chrono::nanoseconds rest);
  /// Whether there is one to take, at once or later.
  [[nodiscard]] bool has_pause();

 private:
  std::chrono::nanoseconds limit_;
  std::mutex mutex_;
  std::chrono::nanoseconds last_look_;
  std::chrono::nanoseconds begin_{};  ///< of the last pause
  std::optional<std::chrono::nanoseconds> pause_;
};

/// Notices that the process as a whole stood still: SIGSTOP, `docker pause`, a suspended machine, a
/// host that has no time for it. Looks at the time on a thread that does nothing else, so that a
/// callback which works for long is no pause.
class PauseWatch {
 public:
  using Clock = std::function<std::chrono::nanoseconds()>;
  /// Since the machine was started, the time in which it was suspended included.
  static std::chrono::nanoseconds machine_time();

  /// `on_pause`: a pause longer than `limit` is over; called on the watch's thread until it is
  /// taken, which it can be once `rest` has passed since it began.
  PauseWatch(std::chrono::nanoseconds limit, std::chrono::nanoseconds rest,
             std::function<void()> on_pause, Clock clock = machine_time);

  /// Looks, too. As PauseDetector::take().
  [[nodiscard]] std::optional<std::chrono::nanoseconds> take();

 private:
  void run(const std::stop_token& stop);

  Clock clock_;
  PauseDetector detector_;
  std::chrono::nanoseconds rest_;
  std::chrono::nanoseconds period_;
  std::function<void()> on_pause_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: stopped and joined first
};

}  // namespace coop::runtime
