// The simulated robot as nine programs: its mission, and its mission with programs that die on the
// way.
#include <gtest/gtest.h>

#include <csignal>

#include "system/mission/mission_watch.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

const std::filesystem::path kLaunch = std::filesystem::path(COOP_SOURCE_DIR) / "config/launch";
constexpr std::chrono::minutes kMissionLimit{10};

/// A collection of two eggs near the start: short, and true in every part.
std::vector<std::string> short_mission() {
  return {"--set", "world=" COOP_SOURCE_DIR "/tests/data/two_eggs.world.yaml", "--set",
          "sequencer.mission.expected_eggs=2"};
}

class MissionSystem : public ::testing::Test {
 protected:
  void start(const std::string& launch_file, const std::vector<std::string>& arguments) {
    system_.emplace(kLaunch / launch_file, arguments);
    watch_.emplace(system_->domain());
    ASSERT_TRUE(system_->wait_until_ready());
  }
  bool wait(const std::function<bool()>& condition) {
    return look_until(*watch_, condition, kMissionLimit);
  }
  void expect_every_egg_accounted_for(int eggs) {
    EXPECT_EQ(watch_->eggs_picked(), eggs) << watch_->mission().detail();
    EXPECT_TRUE(wait([&] { return watch_->eggs_collected() == eggs; }));
    EXPECT_EQ(watch_->mission().eggs().size(), static_cast<std::size_t>(eggs))
        << "no egg counted twice";
    EXPECT_EQ(watch_->truth().collision_count(), 0U);
  }
  std::optional<RunningSystem> system_;
  std::optional<MissionWatch> watch_;
};

TEST_F(MissionSystem, TwoEggsAreFoundAndCollected) {
  start("collect.yaml", short_mission());
  ASSERT_TRUE(wait([&] { return watch_->is_done(); })) << watch_->mission().detail();
  expect_every_egg_accounted_for(2);
  const auto status = system_->stop();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 0);
}

TEST_F(MissionSystem, ASystemStoppedOnTheWayLetsTheRobotComeToRestFirst) {
  start("collect.yaml", short_mission());
  const auto speed = [&] { return std::abs(watch_->truth().velocity().linear().x()); };
  ASSERT_TRUE(wait([&] { return speed() > 0.25; })) << watch_->mission().detail();
  system_->launcher().signal(SIGTERM);
  ASSERT_TRUE(wait([&] { return system_->launcher().wait(milliseconds(0)).has_value(); }));
  EXPECT_LT(speed(), 0.01) << "the last that was heard of the robot";
}

/// In lockstep, where looking again and again takes seconds instead of minutes.
TEST_F(MissionSystem, AnEggThatIsNotThereIsReportedMissingAndTheOthersAreCollected) {
  std::vector<std::string> arguments = short_mission();
  arguments.insert(arguments.end(), {"--set", "lockstep=true", "--set", "rate=0"});
  start("collect.yaml", arguments);
  ASSERT_TRUE(wait([&] {
    return watch_->mission().state() == coop_msgs::msg::MissionStatus_Constants::SEARCHING;
  }));
  watch_->pretend_egg(3.0, 0.0);
  ASSERT_TRUE(wait([&] { return !watch_->mission().eggs().empty(); }));
  ASSERT_TRUE(wait([&] { return watch_->is_done(); })) << watch_->mission().detail();
  EXPECT_EQ(watch_->eggs_missing(), 1) << watch_->mission().detail();
  EXPECT_EQ(watch_->eggs_picked(), 2) << watch_->mission().detail();
  EXPECT_TRUE(wait([&] { return watch_->eggs_collected() == 2; }));
  EXPECT_EQ(watch_->truth().collision_count(), 0U);
}

/// Each program is killed once: a third of them while the robot searches, drives and picks.
TEST_F(MissionSystem, EveryProgramMayDieOnceAndTheMissionStillCompletes) {
  start("collect.yaml", short_mission());
  const auto kill = [&](const std::string& component) {
    const pid_t before = system_->kill_component(component);
    EXPECT_TRUE(system_->wait_for([&](const launcher::SystemView&) {
      const auto row = system_->row(component);
      return row && row->pid != 0 && row->pid != before &&
             (row->state == "ready" || row->state == "degraded");
    })) << component
        << " did not come back";
  };
  namespace State = coop_msgs::msg::MissionStatus_Constants;
  const auto reached = [&](std::uint8_t state) {
    return wait([&] { return watch_->mission().state() == state; });
  };
  ASSERT_TRUE(reached(State::SEARCHING));
  for (const char* component : {"simulator", "lidar_driver", "camera_driver"}) kill(component);
  ASSERT_TRUE(reached(State::DRIVING));
  for (const char* component : {"amcl", "global_planner", "dwa"}) kill(component);
  ASSERT_TRUE(reached(State::PICKING));
  for (const char* component : {"arm_driver", "sequencer"}) kill(component);
  ASSERT_TRUE(wait([&] { return watch_->is_done(); })) << watch_->mission().detail();
  expect_every_egg_accounted_for(2);
}

}  // namespace
}  // namespace coop::test
