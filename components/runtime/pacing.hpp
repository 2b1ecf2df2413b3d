#pragma once
#include <functional>

#include "core/time.hpp"

namespace coop::runtime {

/// How the master of time moves its world on: by `period` a step; step() answers the time reached.
struct TimeLead {
  Duration period{};
  double rate = 0.0;  ///< simulated seconds a second; 0: as fast as possible
  std::function<Time()> step;
};

/// How many ticks of simulated time are due at a wall time.
class Pacing {
 public:
  /// `rate`: simulated seconds a second; 0: as fast as possible.
  Pacing(double rate, Duration tick) : rate_(rate), tick_(tick) {}

  /// Ticks to run now; the first call starts the count. A simulation that cannot keep up, or whose
  /// process slept, falls behind instead of hurrying after: what it lost adds to lost().
  [[nodiscard]] int due(Time wall_now);
  /// The next call of due() starts the count again: the wall's clock was set.
  void restart() {
    base_ = Time{};
    done_ = 0;
  }
  /// Simulated time by which the simulation has fallen behind the wall so far.
  [[nodiscard]] Duration lost() const { return lost_; }
  /// How often due() should be asked.
  [[nodiscard]] Duration period() const;

 private:
  double rate_;
  Duration tick_;
  Time base_{};
  std::int64_t done_ = 0;  ///< ticks since base_
  Duration lost_{0};
};

}  // namespace coop::runtime
