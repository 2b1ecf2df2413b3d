// Somebody sets the system's clock while a component runs by it.
#include <gtest/gtest.h>

#include "runtime/in_process_transport.hpp"
#include "runtime/node.hpp"
#include "runtime/pacing.hpp"

namespace coop::runtime {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using Steady = ClockSettings::Steady;

/// Runs by itself, as the system's does; the test sets it.
class SettableClock : public Clock {
 public:
  [[nodiscard]] Time now() const override { return now_; }
  [[nodiscard]] bool is_system() const override { return true; }
  void set(Time now) { now_ = now; }

 private:
  Time now_ = time_from_seconds(1e6);
};

TEST(ClockSettings, AClockThatOnlyRunsOnWasNotSet) {
  ClockSettings settings;
  for (int i = 0; i < 100; ++i) {
    // A tenth of a per cent fast, as a clock that is being adjusted.
    const auto system = time_from_seconds(1e6) + i * milliseconds(1001);
    EXPECT_EQ(settings.change(system, Steady(i * milliseconds(1000))), Duration{0});
  }
}

TEST(ClockSettings, AStepIsNoticedOnceWithItsSize) {
  ClockSettings settings;
  const Time begin = time_from_seconds(1e6);
  (void)settings.change(begin, Steady(milliseconds(0)));
  EXPECT_EQ(settings.change(begin - hours(1), Steady(milliseconds(0))), -hours(1));
  EXPECT_EQ(settings.change(begin - hours(1) + milliseconds(500), Steady(milliseconds(500))),
            Duration{0});
  EXPECT_EQ(settings.change(begin, Steady(milliseconds(500))), hours(1) - milliseconds(500));
}

class SystemClockSet : public ::testing::Test {
 protected:
  SystemClockSet() : executor_(clock_) {
    options_.name = "base";
    node_.emplace(options_, transport_, clock_, executor_);
    node_->every(milliseconds(20), [this] { ++cycles_; });
    node_->on_clock_jump([this] { ++jumps_; });
  }
  void set(Duration change) {
    clock_.set(clock_.now() + change);
    node_->handle_system_clock_set(change);
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      clock_.set(clock_.now() + milliseconds(20));
      executor_.run_once();
    }
  }
  SettableClock clock_;
  InProcessTransport transport_;
  Executor executor_;
  Options options_;
  std::optional<Node> node_;
  int cycles_ = 0;
  int jumps_ = 0;
};

TEST_F(SystemClockSet, ControlGoesOnAtOnceWhenItIsSetBack) {
  run(5);
  EXPECT_EQ(cycles_, 5);
  set(-hours(1));
  run(5);
  EXPECT_EQ(cycles_, 10);
  EXPECT_EQ(jumps_, 1);
}

TEST_F(SystemClockSet, ASmallStepOrOneForwardIsNoJumpForTheComponent) {
  set(-milliseconds(300));
  run(5);
  set(hours(2));
  run(5);
  EXPECT_EQ(cycles_, 10);
  EXPECT_EQ(jumps_, 0);
}

TEST(PacingOfASetClock, TheWorldGoesOnAtItsPace) {
  Pacing pacing(1.0, milliseconds(10));
  Time wall = time_from_seconds(1e6);
  (void)pacing.due(wall);
  wall += milliseconds(100);
  EXPECT_EQ(pacing.due(wall), 10);
  wall -= hours(1);
  pacing.restart();
  EXPECT_EQ(pacing.due(wall), 0);
  wall += milliseconds(50);
  EXPECT_EQ(pacing.due(wall), 5);
  EXPECT_EQ(pacing.lost(), Duration{0});
}

}  // namespace
}  // namespace coop::runtime
