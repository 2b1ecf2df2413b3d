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
  pause_ = std::max(pause, pause_.value_or(pause));
  return true;
}

std::optional<nanoseconds> PauseDetector::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(pause_, std::nullopt);
}

nanoseconds PauseWatch::machine_time() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return std::chrono::seconds(now.tv_sec) + nanoseconds(now.tv_nsec);
}

PauseWatch::PauseWatch(nanoseconds limit, std::function<void()> on_pause, Clock clock)
    : clock_(std::move(clock)),
      detector_(limit, clock_()),
      period_(std::min(kLongestPeriod, limit / kLooksALimit)),
      on_pause_(std::move(on_pause)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

std::optional<nanoseconds> PauseWatch::take() {
  detector_.look(clock_());
  return detector_.take();
}

void PauseWatch::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (detector_.look(clock_())) on_pause_();
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, period_, [] { return false; });
  }
}

}  // namespace coop::runtime
