// Coming down, asked or not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "launcher/supervisor.hpp"
#include "system/launcher/launch_text.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

void expect_gone(const std::vector<pid_t>& pids) {
  EXPECT_FALSE(pids.empty());
  EXPECT_TRUE(wait_until([&] { return std::ranges::none_of(pids, is_alive); }));
}

TEST(LauncherStopTest, AllStopInReverseOrderAndTheirLastWordsAreKept) {
  LaunchText launch;
  RunningSystem system(
      launch.add("a").add("b", "", "after: [a]").add("c", "", "after: [b]").file());
  ASSERT_TRUE(system.wait_until_ready());
  const std::vector<pid_t> pids = system.pids();
  system.launcher().signal(SIGINT);
  const auto status = system.launcher().wait();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 0);
  EXPECT_THAT(system.launcher().output(),
              ContainsRegex("c: stopped, exit code 0\n.*b: stopped, exit code 0\n.*a: stopped, "
                            "exit code 0\n"));
  EXPECT_THAT(read_file(system.run_folder() / "logs" / "c.log"), HasSubstr("component c stops"));
  expect_gone(pids);
}

TEST(LauncherStopTest, WhoIgnoresSigtermIsKilledAtHisTimeLimit) {
  LaunchText launch;
  RunningSystem system(launch.add("a", "behaviour: ignore_sigterm", "stop_timeout: 0.3").file());
  ASSERT_TRUE(system.wait_until_ready());
  const std::vector<pid_t> pids = system.pids();
  EXPECT_EQ(system.stop().value().code, 0);
  EXPECT_THAT(system.launcher().output(), HasSubstr("a: killed: still there 0.30 s after SIGTERM"));
  expect_gone(pids);
}

TEST(LauncherStopTest, ASecondInterruptKillsAtOnce) {
  LaunchText launch;
  RunningSystem system(launch.add("a", "behaviour: ignore_sigterm", "stop_timeout: 3600").file());
  ASSERT_TRUE(system.wait_until_ready());
  system.launcher().signal(SIGINT);
  ASSERT_TRUE(system.wait_for_state("a", "stopping"));
  system.launcher().signal(SIGINT);
  ASSERT_TRUE(system.launcher().wait());
}

TEST(LauncherStopTest, NothingOutlivesALauncherThatIsKilled) {
  LaunchText launch;
  RunningSystem system(launch.add("a").add("b", "behaviour: ignore_sigterm").file());
  ASSERT_TRUE(system.wait_until_ready());
  const std::vector<pid_t> pids = system.pids();
  system.launcher().signal(SIGKILL);
  ASSERT_TRUE(system.launcher().wait());
  expect_gone(pids);
  // And the domain is free again.
  RunningSystem again(launch.file());
  EXPECT_TRUE(again.wait_until_ready());
}

TEST(LauncherStopTest, TheEndOfTheOneThatMattersEndsTheSystem) {
  LaunchText launch;
  RunningSystem system(launch.add("player", "behaviour: finish, delay: 0.2", "on_exit: shutdown")
                           .add("slam", "", "after: [player]")
                           .file());
  const auto status = system.launcher().wait();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 0);
  EXPECT_THAT(system.launcher().output(), HasSubstr("stopped: player has finished"));
}

TEST(LauncherStopTest, UntilReadyStopsByItself) {
  LaunchText launch;
  RunningSystem system(launch.add("a").add("b").file(), {"--until", "ready"});
  const auto status = system.launcher().wait();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, 0);
  EXPECT_THAT(system.launcher().output(), HasSubstr("all 2 components ready"));
}

TEST(LauncherStopTest, TheMissionsEndIsTheLaunchersExitCode) {
  for (const auto& [behaviour, code] :
       {std::pair{"mission_done", 0}, std::pair{"mission_failed", launcher::kExitMissionFailed}}) {
    LaunchText launch;
    RunningSystem system(launch.add("a", std::string("delay: 0.2, behaviour: ") + behaviour).file(),
                         {"--until", "mission-done"});
    const auto status = system.launcher().wait();
    ASSERT_TRUE(status);
    EXPECT_EQ(status->code, code);
    EXPECT_THAT(system.launcher().output(), HasSubstr("five of five"));
  }
}

TEST(LauncherStopTest, WhatIsNotDoneInTimeEndsWithItsOwnExitCode) {
  LaunchText launch;
  RunningSystem system(launch.add("a").file(), {"--until", "mission-done", "--timeout", "1"});
  const auto status = system.launcher().wait();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, launcher::kExitTimeout);
  EXPECT_THAT(system.launcher().output(),
              HasSubstr("launcher: not done within the time limit of 1 s"));
}

}  // namespace
}  // namespace coop::test
