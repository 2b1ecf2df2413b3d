// A whole lockstep in one process: master, followers and their nodes on the in-process transport.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "runtime/in_process_transport.hpp"
#include "runtime/lockstep/follower.hpp"
#include "runtime/lockstep/master.hpp"
#include "runtime/node.hpp"
#include "std_msgs/msg/String.h"
#include "support/temporary_folder.hpp"

namespace coop::runtime {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using Text = std_msgs::msg::String;

Text text(const std::string& data) {
  Text message;
  message.data(data);
  return message;
}

Options named(const std::string& name) {
  Options options;
  options.name = name;
  options.lockstep = true;
  return options;
}

/// What every program of a lockstep has, as run.cpp puts it together.
struct Program {
  Program(InProcessTransport& bus, const std::string& name, const std::filesystem::path& run_dir)
      : options(named(name)), trace(run_dir, name), transport(bus, name, &trace), executor(clock) {}
  Options options;
  SampleTrace trace;
  LockstepTransport transport;
  ManualClock clock;
  Executor executor;
};

struct World : Program {
  World(InProcessTransport& bus, std::vector<std::string> members,
        const std::filesystem::path& run_dir)
      : Program(bus, "world", run_dir),
        master(executor, bus, transport, "world", std::move(members)),
        node(options, transport, clock, executor) {
    readings = node.advertise<Text>("reading", Qos::kSensorStream);
    node.subscribe<Text>("command", Qos::kCommand,
                         [this](const Text& message) { commands.push_back(message.data()); });
    node.lead_time({.period = milliseconds(10), .rate = 0.0, .step = [this] {
                      readings.publish(text("reading " + std::to_string(++steps)));
                      clock.set(Time(milliseconds(1000 + 10 * steps)));
                      return clock.now();
                    }});
    master.start(node, *node.time_lead());
  }
  LockstepMaster master;
  Node node;
  Publisher<Text> readings;
  std::vector<std::string> commands;
  std::int64_t steps = 0;
};

/// Answers every reading with a command and says every 30 ms what its clock reads.
struct Driver : Program {
  Driver(InProcessTransport& bus, const std::string& name, const std::filesystem::path& run_dir)
      : Program(bus, name, run_dir),
        follower(executor, bus, transport, name),
        node(options, transport, clock, executor) {
    commands = node.advertise<Text>("command", Qos::kCommand);
    node.subscribe<Text>("reading", Qos::kSensorStream, [this](const Text& message) {
      heard.push_back(message.data());
      commands.publish(text(options.name + ": " + message.data()));
    });
    node.every(milliseconds(30), [this] {
      commands.publish(text(options.name + " at " + std::to_string(to_nanoseconds(node.now()))));
    });
    follower.join(node.log(), [this](Time time) {
      const bool is_first = clock.now() == Time{};
      clock.set(time);
      if (is_first) node.handle_clock_jump();
    });
  }
  LockstepFollower follower;
  Node node;
  Publisher<Text> commands;
  std::vector<std::string> heard;
};

class LockstepTest : public ::testing::Test {
 protected:
  /// Gives everybody a turn, in an order drawn anew each time, until `done`.
  void run_until(const std::function<bool()>& done, std::uint32_t order_seed = 1) {
    std::mt19937 order(order_seed);
    for (int turn = 0; turn < 100'000 && !done(); ++turn) {
      std::vector<Program*> programs = everybody_();
      std::ranges::shuffle(programs, order);
      for (Program* program : programs) program->executor.run_once();
    }
    ASSERT_TRUE(done());
  }
  std::vector<Program*> everybody_() const {
    std::vector<Program*> programs;
    if (world_) programs.push_back(world_.get());
    for (const auto& [name, driver] : drivers_) programs.push_back(driver.get());
    return programs;
  }
  void add_driver(const std::string& name) {
    drivers_[name] = std::make_unique<Driver>(bus_, name, folder_.path());
  }
  void add_world(std::vector<std::string> members) {
    world_ = std::make_unique<World>(bus_, std::move(members), folder_.path());
  }

  test::TemporaryFolder folder_;
  InProcessTransport bus_{true};
  std::unique_ptr<World> world_;
  std::map<std::string, std::unique_ptr<Driver>> drivers_;
};

TEST_F(LockstepTest, TheWorldWaitsForEverybodyAndAnswersComeOneTickLater) {
  add_world({"left", "right"});
  add_driver("right");
  for (int i = 0; i < 100; ++i) {
    world_->executor.run_once();
    drivers_["right"]->executor.run_once();
  }
  EXPECT_EQ(world_->steps, 0);
  add_driver("left");
  run_until([&] { return world_->steps == 3; });
  EXPECT_THAT(world_->commands, ElementsAre("left: reading 1", "right: reading 1",
                                            "left: reading 2", "right: reading 2"));
}

TEST_F(LockstepTest, TheOrderInWhichProgramsRunChangesNothing) {
  std::vector<std::vector<std::string>> results;
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    drivers_.clear();
    world_.reset();
    add_world({"left", "right"});
    add_driver("left");
    add_driver("right");
    run_until([&] { return world_->steps == 100; }, seed);
    results.push_back(world_->commands);
  }
  EXPECT_GT(results[0].size(), 200U);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

TEST_F(LockstepTest, TimeStandsStillWithoutADeadMemberAndGoesOnWithItsSuccessor) {
  add_world({"left", "right"});
  add_driver("left");
  add_driver("right");
  run_until([&] { return world_->steps == 10; });
  drivers_.erase("left");
  for (int i = 0; i < 100; ++i) {
    world_->executor.run_once();
    drivers_["right"]->executor.run_once();
  }
  EXPECT_LE(world_->steps, 11);
  add_driver("left");
  run_until([&] { return world_->steps == 20; });
  EXPECT_THAT(drivers_["left"]->heard, ::testing::Contains("reading 19"));
  EXPECT_THAT(drivers_["left"]->heard, ::testing::Not(::testing::Contains("reading 9")));
}

TEST_F(LockstepTest, AMemberThatLeavesIsNotWaitedFor) {
  add_world({"left", "right"});
  add_driver("left");
  add_driver("right");
  run_until([&] { return world_->steps == 10; });
  drivers_["left"]->follower.leave();
  run_until([&] { return drivers_["right"]->heard.back() == "reading 20"; });
}

TEST_F(LockstepTest, FollowersJoinAMasterThatStartsAnew) {
  add_world({"left"});
  add_driver("left");
  run_until([&] { return world_->steps == 10; });
  world_.reset();
  add_world({"left"});
  run_until([&] { return world_->steps == 10; });
  EXPECT_EQ(world_->commands.front(), "left: reading 1");
}

TEST_F(LockstepTest, SamplesFromOutsideArriveWithTheNextTick) {
  add_world({"left"});
  add_driver("left");
  run_until([&] { return world_->steps == 2; });
  ManualClock clock;
  Executor executor(clock);
  Node person(named("person"), bus_, clock, executor);
  auto commands = person.advertise<Text>("command", Qos::kCommand);
  commands.publish(text("stop"));
  run_until([&] { return world_->steps == 4; });
  EXPECT_THAT(world_->commands, ::testing::Contains("stop"));
}

TEST_F(LockstepTest, TracesOfEqualRunsAreEqualAndTheFirstDifferenceIsNamed) {
  const auto run = [&](const std::filesystem::path& run_dir, bool disturbed) {
    InProcessTransport bus(true);
    World world(bus, {"left"}, run_dir);
    Driver left(bus, "left", run_dir);
    for (int i = 0; i < 100'000 && world.steps < 50; ++i) {
      if (disturbed && world.steps == 20) left.options.name = "somebody else";
      world.executor.run_once();
      left.executor.run_once();
    }
    ASSERT_EQ(world.steps, 50);
  };
  const auto a = folder_.path() / "a";
  const auto b = folder_.path() / "b";
  const auto c = folder_.path() / "c";
  run(a, false);
  run(b, false);
  run(c, true);
  EXPECT_EQ(first_difference(a, b), std::nullopt);
  EXPECT_EQ(summarise_traces(a).hash, summarise_traces(b).hash);
  EXPECT_NE(summarise_traces(a).hash, summarise_traces(c).hash);
  const auto difference = first_difference(a, c);
  ASSERT_TRUE(difference);
  EXPECT_THAT(*difference, ::testing::StartsWith("tick 21, command of left, sample "));
  EXPECT_EQ(first_difference(a, c, 20), std::nullopt);
}

}  // namespace
}  // namespace coop::runtime
