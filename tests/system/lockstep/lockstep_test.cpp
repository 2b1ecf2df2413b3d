// The whole simulated robot in lockstep, as separate processes over DDS: one seed, one result, to
// the bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <map>
#include <thread>

#include "coop_msgs/msg/GroundTruth.h"
#include "runtime/lockstep/sample_trace.hpp"
#include "system/support/listener.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

using runtime::first_difference;
using runtime::summarise_traces;

const std::filesystem::path kLaunch =
    std::filesystem::path(COOP_SOURCE_DIR) / "config/launch/collect.yaml";
constexpr std::chrono::minutes kRunLimit{5};

using Arguments = std::vector<std::string>;

Arguments operator+(Arguments left, const Arguments& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// The robot looks for eggs for some seconds of simulated time, as fast as it can.
Arguments in_lockstep(int seed, double duration) {
  return {"--set", "lockstep=true",
          "--set", "trace=true",
          "--set", "rate=0",
          "--set", "seed=" + std::to_string(seed),
          "--set", "simulator.duration=" + std::to_string(duration),
          "--set", "components.simulator.on_exit=shutdown"};
}

/// Every program at once instead of one after the other.
Arguments without_order() {
  Arguments arguments;
  for (const char* component : {"lidar_driver", "camera_driver", "arm_driver", "amcl",
                                "global_planner", "dwa", "sequencer"}) {
    arguments =
        arguments + Arguments{"--set", std::string("components.") + component + ".after=[]"};
  }
  return arguments;
}

/// Keeps both processors busy while it lives.
class Load {
 public:
  Load() {
    for (auto& thread : threads_) {
      thread = std::jthread([](const std::stop_token& stop) {
        volatile std::uint64_t x = 1;
        while (!stop.stop_requested()) x = x * 6364136223846793005U + 1442695040888963407U;
      });
    }
  }

 private:
  std::array<std::jthread, 3> threads_;
};

/// A run to its end; the folder with its traces stays as long as the object.
class FinishedRun {
 public:
  explicit FinishedRun(const Arguments& arguments) : system_(kLaunch, arguments) {
    const auto status = system_.launcher().wait(kRunLimit);
    ok_ = status && status->clean();
    if (!ok_) ADD_FAILURE() << "the run did not end well:\n" << system_.launcher().output();
  }
  [[nodiscard]] std::filesystem::path folder() { return system_.folder() / "runs/latest"; }
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  RunningSystem system_;
  bool ok_ = false;
};

TEST(Lockstep, OneSeedGivesOneResultToTheBitUnderLoadAndInAnyOrderOfStarts) {
  FinishedRun run(in_lockstep(1, 20.0));
  ASSERT_TRUE(run.ok());
  const auto summary = summarise_traces(run.folder());
  EXPECT_EQ(summary.last_tick, 2000U);
  EXPECT_TRUE(summary.topics.contains("dwa cmd_vel"));
  {
    const Load load;
    FinishedRun under_load(in_lockstep(1, 20.0) + without_order());
    ASSERT_TRUE(under_load.ok());
    EXPECT_EQ(first_difference(run.folder(), under_load.folder()), std::nullopt);
    EXPECT_EQ(summary.hash, summarise_traces(under_load.folder()).hash);
  }
  FinishedRun another(in_lockstep(2, 20.0));
  ASSERT_TRUE(another.ok());
  EXPECT_NE(summary.hash, summarise_traces(another.folder()).hash);
}

class LockstepFaults : public ::testing::Test {
 protected:
  void start(double duration) {
    system_.emplace(kLaunch, in_lockstep(1, duration));
    listener_.emplace(system_->domain(), "observer");
    listener_->node().subscribe<coop_msgs::msg::GroundTruth>(
        "ground_truth", runtime::Qos::kSensorStream,
        [this](const coop_msgs::msg::GroundTruth& truth) {
          seconds_ = truth.header().stamp().sec();
        });
  }
  bool reached(int seconds) {
    return wait_until(
        [&] {
          listener_->look();
          return seconds_ >= seconds;
        },
        kRunLimit);
  }
  std::optional<RunningSystem> system_;
  std::optional<Listener> listener_;
  int seconds_ = 0;
};

TEST_F(LockstepFaults, AProgramThatIsKilledComesBackAndTheRunGoesOnToItsEnd) {
  start(30.0);
  for (const auto& [component, seconds] :
       std::map<std::string, int>{{"amcl", 5}, {"dwa", 10}, {"sequencer", 15}}) {
    ASSERT_TRUE(reached(seconds)) << component;
    system_->kill_component(component);
  }
  ASSERT_TRUE(reached(20));
  system_->kill_component("simulator");
  const auto status = system_->launcher().wait(kRunLimit);
  ASSERT_TRUE(status);
  EXPECT_TRUE(status->clean()) << system_->launcher().output();
}

TEST_F(LockstepFaults, TimeStandsStillWhileAProgramStandsAndTheMasterSaysWho) {
  start(600.0);
  ASSERT_TRUE(reached(3));
  const auto row = system_->row("dwa");
  ASSERT_TRUE(row);
  ASSERT_EQ(::kill(row->pid, SIGSTOP), 0);
  EXPECT_TRUE(system_->wait_for([&](const launcher::SystemView&) {
    const auto simulator = system_->row("simulator");
    return simulator && simulator->state == "degraded" &&
           simulator->detail.starts_with("lockstep waits for dwa");
  }));
  listener_->look();
  const int stopped_at = seconds_;
  // The launcher takes a program that is silent for a hanging one and starts it anew.
  EXPECT_TRUE(reached(stopped_at + 3));
}

}  // namespace
}  // namespace coop::test
