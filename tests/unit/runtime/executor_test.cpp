#include "runtime/executor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace coop::runtime {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

struct Script : InputSource {
  Script(std::vector<std::string>& log, std::string name) : log_(log), name_(std::move(name)) {}
  bool handle_one() override {
    if (pending == 0) return false;
    --pending;
    log_.push_back(name_);
    return true;
  }
  int pending = 0;

 private:
  std::vector<std::string>& log_;
  std::string name_;
};

class ExecutorTest : public ::testing::Test {
 protected:
  void advance(Duration duration) { clock_.set(clock_.now() + duration); }
  ManualClock clock_;
  Executor executor_{clock_};
  std::vector<std::string> log_;
};

TEST_F(ExecutorTest, InputsRunInTheOrderTheirSourcesWereAddedAndBeforeTimers) {
  Script first(log_, "first");
  Script second(log_, "second");
  executor_.add_source(first);
  executor_.add_source(second);
  executor_.add_timer(milliseconds(10), [this] { log_.emplace_back("timer"); });
  second.pending = 1;
  first.pending = 2;
  advance(milliseconds(10));
  EXPECT_TRUE(executor_.run_once());
  EXPECT_THAT(log_, ElementsAre("first", "first", "second", "timer"));
  EXPECT_FALSE(executor_.run_once());
}

TEST_F(ExecutorTest, TimersRunByDueTimeThenByOrderOfCreation) {
  executor_.add_timer(milliseconds(20), [this] { log_.emplace_back("slow"); });
  executor_.add_timer(milliseconds(10), [this] { log_.emplace_back("fast"); });
  advance(milliseconds(10));
  executor_.run_once();
  advance(milliseconds(10));
  executor_.run_once();
  EXPECT_THAT(log_, ElementsAre("fast", "slow", "fast"));
}

TEST_F(ExecutorTest, MissedTimersAreNotMadeUpFor) {
  executor_.add_timer(milliseconds(10), [this] { log_.emplace_back("tick"); });
  advance(milliseconds(95));
  executor_.run_once();
  EXPECT_EQ(log_.size(), 1U);
  advance(milliseconds(5));
  executor_.run_once();
  EXPECT_EQ(log_.size(), 2U) << "back on the grid of its period";
}

TEST_F(ExecutorTest, AClockSetBackRebasesTheTimers) {
  advance(std::chrono::hours(1));
  executor_.add_timer(milliseconds(10), [this] { log_.emplace_back("tick"); });
  clock_.set(Time(milliseconds(5)));
  executor_.on_clock_jump();
  advance(milliseconds(10));
  executor_.run_once();
  EXPECT_EQ(log_.size(), 1U);
}

TEST_F(ExecutorTest, AWakeFromAnotherThreadEndsTheWait) {
  Script source(log_, "input");
  executor_.add_source(source);
  executor_.wait_and_run(milliseconds(0));  // takes the wake of add_source
  std::thread waker([&] { executor_.wake(); });
  const auto begin = Executor::Wall::now();
  source.pending = 1;
  executor_.wait_and_run(std::chrono::minutes(1));
  waker.join();
  EXPECT_LT(Executor::Wall::now() - begin, std::chrono::seconds(30));
  EXPECT_EQ(log_.size(), 1U);
}

TEST_F(ExecutorTest, ACallbackMayAddTimersAndSources) {
  Script late(log_, "late");
  executor_.add_timer(milliseconds(10), [&] {
    late.pending = 1;
    executor_.add_source(late);
    for (int i = 0; i < 100; ++i) executor_.add_timer(milliseconds(10), [] {});
  });
  advance(milliseconds(10));
  executor_.run_once();
  executor_.run_once();
  EXPECT_THAT(log_, ElementsAre("late"));
}

}  // namespace
}  // namespace coop::runtime
