// The whole simulated robot with keys: it comes up, drives and collects as without, and who has
// none neither hears it nor moves it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "system/mission/mission_watch.hpp"
#include "system/security/guest.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kRobot = "ducky";
constexpr std::chrono::minutes kMissionLimit{5};

class SecuredRobot : public ::testing::Test {
 protected:
  SecuredRobot() : keys_(folder_.path() / "keys") {}
  ~SecuredRobot() override { unsetenv("COOP_DDS"); }

  static std::vector<std::string> joined(std::vector<std::string> some,
                                         const std::vector<std::string>& more) {
    some.insert(some.end(), more.begin(), more.end());
    return some;
  }
  std::string run(const std::string& program, const std::vector<std::string>& arguments) {
    Program running(program, arguments, folder_.path() / "output");
    const auto status = running.wait();
    EXPECT_TRUE(status && status->code == 0) << program << ": " << running.output();
    return running.output();
  }
  /// The shipped mission with a world of two eggs; answers once all are ready.
  void start(const std::vector<std::string>& settings) {
    const std::string launch = COOP_SOURCE_DIR "/config/launch/collect.yaml";
    run("keys", joined({"make", launch, "--folder", keys_.string(), "--observer", "watch",
                        "--robot", kRobot, "--domain", std::to_string(test_domain())},
                       settings));
    system_.emplace(launch, joined({"--robot", kRobot, "--set", "dds.security=on", "--set",
                                    "dds.keys=" + keys_.string(), "--set",
                                    "world=" COOP_SOURCE_DIR "/tests/data/two_eggs.world.yaml",
                                    "--set", "sequencer.mission.expected_eggs=2"},
                                   settings));
    ASSERT_TRUE(system_->wait_until_ready()) << system_->launcher().output();
    watch_.emplace(guest_options("watch", kRobot, keys_));
  }
  bool wait(const std::function<bool()>& condition) {
    return look_until(*watch_, condition, kMissionLimit);
  }
  /// A tool of a person, who has keys.
  std::string tool(const std::string& program, std::vector<std::string> arguments) {
    const std::string settings = "security=on keys=" + keys_.string();
    setenv("COOP_DDS", settings.c_str(), 1);
    arguments.insert(arguments.end(),
                     {"--domain", std::to_string(test_domain()), "--robot", kRobot});
    std::string output = run(program, arguments);
    unsetenv("COOP_DDS");
    return output;
  }

  TemporaryFolder folder_;
  fs::path keys_;
  std::optional<RunningSystem> system_;
  std::optional<MissionWatch> watch_;
};

TEST_F(SecuredRobot, DrivesWhileAGuestWithoutKeysHearsNothingAndMovesNothing) {
  // One that listens, and then one that drives: two at once would hear each other.
  std::optional<Guest> guest(std::in_place, "person", kRobot, fs::path());
  guest->listen_to_scans();
  guest->listen_to_commands();
  ASSERT_NO_FATAL_FAILURE(start({}));
  Guest observer("watch", kRobot, keys_);
  observer.listen_to_commands();
  const auto robot_drives = [&](int commands) {
    return wait([&] {
      observer.look();
      guest->look();
      return observer.commands() >= commands &&
             std::abs(watch_->truth().velocity().linear().x()) > 0.2;
    });
  };
  EXPECT_TRUE(robot_drives(40)) << watch_->mission().detail();
  EXPECT_EQ(guest->scans(), 0);
  EXPECT_EQ(guest->commands(), 0);
  guest.emplace("dwa", kRobot, fs::path());
  guest->drive();
  EXPECT_TRUE(robot_drives(observer.commands() + 40)) << watch_->mission().detail();
  EXPECT_EQ(guest->driven(), 0);

  const std::string topics = tool("topic", {"list"});
  for (const char* topic : {"cmd_vel", "global_costmap", "tf_static"}) {
    EXPECT_THAT(topics, HasSubstr(topic));
  }
  EXPECT_THAT(tool("topic", {"echo", "scan", "--count", "1"}), HasSubstr("ranges"));
  EXPECT_THAT(tool("health", {}), HasSubstr("sequencer: "));
  EXPECT_EQ(watch_->truth().collision_count(), 0U);
}

/// In lockstep: its topics too are open to those alone who take part.
TEST_F(SecuredRobot, CollectsEveryEggOfAMission) {
  ASSERT_NO_FATAL_FAILURE(start({"--set", "lockstep=true", "--set", "rate=0"}));
  ASSERT_TRUE(wait([&] { return watch_->is_done(); })) << watch_->mission().detail();
  EXPECT_EQ(watch_->eggs_picked(), 2) << watch_->mission().detail();
  EXPECT_TRUE(wait([&] { return watch_->eggs_collected() == 2; }));
  EXPECT_EQ(watch_->mission().eggs().size(), 2U) << "no egg counted twice";
  EXPECT_EQ(watch_->truth().collision_count(), 0U);
}

}  // namespace
}  // namespace coop::test
