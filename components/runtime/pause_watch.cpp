#include "runtime/pause_watch.hpp"

#include <algorithm>
#include <ctime>
#include <utility>

namespace coop::runtime {
namespace {

using std::chrono::nanoseconds;

/// Of the thread's looks; a pause is known that much later, at most.
constexpr nanoseconds kLongestPeriod = std::chrono::milliseconds(500);
constexpr int kLooksALimit = 4;

}  // namespace

bool PauseDetector::look(nanoseconds now) {
  const std::scoped_lock lock(mutex_);
  const nanoseconds pause = now - last_look_;
  last_look_ = std::max(last_look_, now);
  if (pause <= limit_) return false;
  begin_ = now - pause;
  pause_ = std::max(pause, pause_.value_or(pause));
  return true;
}

bool PauseDetector::has_pause() {
  const std::scoped_lock lock(mutex_);
  return pause_.has_value();
}

std::optional<nanoseconds> PauseDetector::take(nanoseconds now, nanoseconds rest) {
  const std::scoped_lock lock(mutex_);
  if (now < begin_ + rest) return std::nullopt;
  return std::exchange(pause_, std::nullopt);
}

nanoseconds PauseWatch::machine_time() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return std::chrono::seconds(now.tv_sec) + nanoseconds(now.tv_nsec);
}

PauseWatch::PauseWatch(nanoseconds limit, nanoseconds rest, std::function<void()> on_pause,
                       Clock clock)
    : clock_(std::move(clock)),
      detector_(limit, clock_()),
      rest_(rest),
      period_(std::min(kLongestPeriod, limit / kLooksALimit)),
      on_pause_(std::move(on_pause)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::optional<nanoseconds> PauseWatch::take() {
  const nanoseconds now = clock_();
  detector_.look(now);
  return detector_.take(now, rest_);
}

void PauseWatch::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (detector_.look(clock_()) || detector_.has_pause()) on_pause_();
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, period_, [] { return false; });
  }
}

}  // namespace coop::runtime
