#include "runtime/executor.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace coop::runtime {

Executor::Executor(const Clock& clock)
    : clock_(clock), event_fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (event_fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Executor::~Executor() {
  ::close(event_fd_);
}

void Executor::add_source(InputSource& source) {
  sources_.push_back(&source);
  wake();
}

void Executor::remove_source(InputSource& source) {
  std::erase(sources_, &source);
}

Time Executor::first_due(Duration period, bool aligned, Time now) {
  return now + period - (aligned ? now.time_since_epoch() % period : Duration{0});
}

void Executor::add_timer(Duration period, Callback callback, bool aligned) {
  timers_.push_back(
      {period, aligned, first_due(period, aligned, clock_.now()), std::move(callback)});
}

void Executor::add_wall_timer(std::chrono::nanoseconds period, Callback callback) {
  wall_timers_.push_back({period, Wall::now() + period, std::move(callback)});
}

void Executor::call_at(Wall::time_point due, Callback callback) {
  appointment_ = due;
  appointed_ = std::move(callback);
}

void Executor::wake() noexcept {
  const std::uint64_t one = 1;
  // Fails only when the counter is full, and then the executor is awake anyway.
  [[maybe_unused]] const ssize_t written = ::write(event_fd_, &one, sizeof one);
}

bool Executor::run_once() {
  const bool had_inputs = run_inputs();
  const bool had_timers = run_timers();
  round_end_();
  return had_inputs || had_timers;
}

bool Executor::run_inputs() {
  bool any = false;
  // By index: a callback may add a source.
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    while (sources_[i]->handle_one()) any = true;
  }
  return any;
}

bool Executor::run_due_clock_timers(Time now) {
  bool any = false;
  for (;;) {
    Timer* next = nullptr;
    for (Timer& timer : timers_) {
      if (timer.due <= now && (next == nullptr || timer.due < next->due)) next = &timer;
    }
    if (next == nullptr) return any;
    next->due += next->period;
    if (next->due <= now) {
      const auto missed = (now - next->due) / next->period + 1;
      next->due += missed * next->period;
    }
    const Callback callback = next->callback;  // the vector may grow while it runs
    callback();
    any = true;
  }
}

bool Executor::run_timers() {
  bool any = run_due_clock_timers(clock_.now());
  const auto now = Wall::now();
  for (std::size_t i = 0; i < wall_timers_.size(); ++i) {
    if (wall_timers_[i].due > now) continue;
    wall_timers_[i].due = now + wall_timers_[i].period;
    const Callback callback = wall_timers_[i].callback;
    callback();
    any = true;
  }
  if (appointment_ <= now) {
    appointment_ = Wall::time_point::max();
    const Callback callback = std::exchange(appointed_, {});
    callback();
    any = true;
  }
  return any;
}

std::chrono::nanoseconds Executor::time_to_next_timer() const {
  auto wait = std::chrono::nanoseconds::max();
  if (clock_.is_system()) {
    const Time now = clock_.now();
    for (const Timer& timer : timers_) wait = std::min(wait, timer.due - now);
  }
  const auto now = Wall::now();
  for (const WallTimer& timer : wall_timers_) {
    wait = std::min(wait, std::chrono::nanoseconds(timer.due - now));
  }
  if (appointment_ != Wall::time_point::max()) {
    wait = std::min(wait, std::chrono::nanoseconds(appointment_ - now));
  }
  return std::max(wait, std::chrono::nanoseconds(0));
}

void Executor::wait_and_run(std::chrono::nanoseconds timeout) {
  const auto wait = std::min(timeout, time_to_next_timer());
  pollfd fd{event_fd_, POLLIN, 0};
  const timespec limit{wait.count() / 1'000'000'000, wait.count() % 1'000'000'000};
  if (::ppoll(&fd, 1, &limit, nullptr) > 0) {
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t got = ::read(event_fd_, &count, sizeof count);
  }
  run_once();
}

void Executor::set_round_end(Callback callback) {
  round_end_ = std::move(callback);
}

Time Executor::next_due() const {
  Time next = Time::max();
  for (const Timer& timer : timers_) next = std::min(next, timer.due);
  return next;
}

void Executor::on_clock_jump() {
  const Time now = clock_.now();
  for (Timer& timer : timers_) timer.due = first_due(timer.period, timer.aligned, now);
}

}  // namespace coop::runtime
