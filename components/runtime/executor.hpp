#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "core/time.hpp"
#include "runtime/clock.hpp"

namespace coop::runtime {

/// Anything that holds inputs for the executor: handle_one() runs the callback of one input and
/// answers whether there was one.
class InputSource {
 public:
  virtual ~InputSource() = default;
  virtual bool handle_one() = 0;
};

/// One thread that runs everything of a component: inputs in the order in which their sources were
/// added, then the timers that are due, by due time and order of creation. Callbacks never overlap.
///
/// What a round consists of is here alone, so that a scheduler which holds rounds back until all
/// inputs of a tick have arrived (lockstep) can drive run_inputs() and run_timers() itself.
class Executor {
 public:
  using Callback = std::function<void()>;
  using Wall = std::chrono::steady_clock;

  explicit Executor(const Clock& clock);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// The source must live as long as the executor or until removed.
  void add_source(InputSource& source);
  void remove_source(InputSource& source);

  /// Calls back every `period` of the component's clock, first one period from now. Late calls are
  /// not made up for.
  /// `aligned`: at the multiples of `period` instead.
  void add_timer(Duration period, Callback callback, bool aligned = false);
  /// The same by the steady clock, for what must go on while simulated time stands still.
  void add_wall_timer(std::chrono::nanoseconds period, Callback callback);
  /// Calls back once at a point of the steady clock, in place of what was asked for before and has
  /// not been called yet.
  void call_at(Wall::time_point due, Callback callback);

  /// From any thread or signal handler: there is something to do.
  void wake() noexcept;

  /// One round without waiting: all inputs at hand, then due timers. Answers whether anything ran.
  bool run_once();
  /// Waits for work, at most `timeout`, then does a round.
  void wait_and_run(std::chrono::nanoseconds timeout);

  bool run_inputs();
  bool run_timers();
  /// Called at the end of every round.
  void set_round_end(Callback callback);
  /// When the next timer of the component's clock is due; Time::max() without timers.
  [[nodiscard]] Time next_due() const;
  /// Re-bases the timers after the clock was set back or first set.
  void on_clock_jump();

 private:
  struct Timer {
    Duration period;
    bool aligned;
    Time due;
    Callback callback;
  };
  struct WallTimer {
    std::chrono::nanoseconds period;
    Wall::time_point due;
    Callback callback;
  };
  [[nodiscard]] std::chrono::nanoseconds time_to_next_timer() const;
  static Time first_due(Duration period, bool aligned, Time now);
  bool run_due_clock_timers(Time now);

  const Clock& clock_;
  int event_fd_;
  std::vector<InputSource*> sources_;
  std::vector<Timer> timers_;
  std::vector<WallTimer> wall_timers_;
  Wall::time_point appointment_ = Wall::time_point::max();
  Callback appointed_;
  Callback round_end_ = [] {};
};

}  // namespace coop::runtime
