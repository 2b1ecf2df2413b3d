// What dies, hangs or never comes up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "launcher/supervisor.hpp"
#include "system/launcher/launch_text.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(LauncherRestartTest, AKilledComponentComesBackAndTheOthersStay) {
  LaunchText launch;
  RunningSystem system(launch.add("a").add("b", "", "after: [a]").file());
  ASSERT_TRUE(system.wait_until_ready()) << system.launcher().output();
  const pid_t b = system.row("b").value().pid;
  const pid_t killed = system.kill_component("a");
  EXPECT_TRUE(system.wait_for([&](const launcher::SystemView& now) {
    return now.rows[0].state == "ready" && now.rows[0].pid != killed;
  }));
  EXPECT_EQ(system.row("a").value().restarts, 1);
  EXPECT_EQ(system.row("b").value().pid, b);
  EXPECT_THAT(system.launcher().output(), HasSubstr("a: killed by signal 9"));
  ASSERT_TRUE(system.stop());
}

TEST(LauncherRestartTest, AStoppedProcessIsNoticedByItsHeartbeatAndReplaced) {
  LaunchText launch;
  RunningSystem system(launch.add("a", "", "heartbeat_timeout: 1.5").file());
  ASSERT_TRUE(system.wait_until_ready());
  const pid_t before = system.row("a").value().pid;
  kill(before, SIGSTOP);
  EXPECT_TRUE(system.wait_for_state("a", "silent"));
  EXPECT_TRUE(system.wait_for([&](const launcher::SystemView& now) {
    return now.rows[0].state == "ready" && now.rows[0].pid != before;
  }));
  EXPECT_FALSE(is_alive(before));
  EXPECT_THAT(system.launcher().output(), HasSubstr("a: hangs: no heartbeat for 1.5"));
}

TEST(LauncherRestartTest, ACallbackThatNeverReturnsIsAHangToo) {
  LaunchText launch;
  const std::string once = (launch.folder() / "hung").string();
  RunningSystem system(
      launch.add("a", "behaviour: hang, once: \"" + once + "\"", "heartbeat_timeout: 1.5").file());
  EXPECT_TRUE(system.wait_for([](const launcher::SystemView& now) {
    return now.rows[0].state == "ready" && now.rows[0].restarts == 1;
  }));
  EXPECT_THAT(system.launcher().output(), HasSubstr("a: hangs"));
}

TEST(LauncherRestartTest, OneCrashAtStartIsNotTheEnd) {
  LaunchText launch;
  const std::string once = (launch.folder() / "crashed").string();
  RunningSystem system(launch.add("a", "behaviour: crash_at_start, once: \"" + once + "\"").file());
  EXPECT_TRUE(system.wait_until_ready());
  EXPECT_EQ(system.row("a").value().restarts, 1);
  EXPECT_THAT(system.launcher().output(), HasSubstr("exit code 17 (last line: about to crash)"));
}

TEST(LauncherRestartTest, ACrashLoopStopsTheSystemWithOneLineAndLeavesNothingBehind) {
  LaunchText launch;
  RunningSystem system(launch.add("good")
                           .add("bad", "behaviour: crash",
                                "restart: {give_up_after: 3, min_backoff: 0.05}, after: [good]")
                           .file(),
                       {"--quiet"});
  ASSERT_TRUE(system.wait_for_state("good", "ready"));
  const std::vector<pid_t> pids = system.pids();
  const auto status = system.launcher().wait();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, launcher::kExitGivenUp);
  EXPECT_THAT(
      system.launcher().output(),
      testing::MatchesRegex(
          "launcher: bad given up: exit code 17, failure 3 in [0-9.]+ s \\(last line: about "
          "to crash\\)\n"));
  for (const pid_t pid : pids) EXPECT_FALSE(is_alive(pid));
}

TEST(LauncherRestartTest, WhoNeverGetsReadyIsGivenUpAfterHisTime) {
  LaunchText launch;
  RunningSystem system(
      launch.add("a", "behaviour: never_ready", "start_timeout: 0.5, restart: {policy: never}")
          .file(),
      {"--quiet"});
  const auto status = system.launcher().wait();
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, launcher::kExitGivenUp);
  EXPECT_THAT(system.launcher().output(), HasSubstr("a given up: not ready within 0.50 s"));
}

TEST(LauncherRestartTest, OneThatIsNotRequiredMayFail) {
  LaunchText launch;
  RunningSystem system(
      launch.add("a")
          .add("extra", "behaviour: crash_at_start", "required: false, restart: {policy: never}")
          .file());
  EXPECT_TRUE(system.wait_for_state("extra", "failed"));
  EXPECT_TRUE(system.wait_for_state("a", "ready"));
  EXPECT_EQ(system.stop().value().code, 0);
}

TEST(LauncherRestartTest, AFloodOfOutputSlowsNobodyAndItsLogIsRotated) {
  LaunchText launch;
  RunningSystem system(
      launch.add("a").add("loud", "behaviour: flood", "log: {max_size: 1, keep: 2}").file());
  ASSERT_TRUE(system.wait_until_ready());
  const auto logs = system.run_folder() / "logs";
  EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(logs / "loud.log.2"); }));
  EXPECT_EQ(system.row("a").value().state, "ready");
  EXPECT_EQ(system.row("loud").value().restarts, 0);
  EXPECT_EQ(system.stop().value().code, 0);
  EXPECT_FALSE(std::filesystem::exists(logs / "loud.log.3"));
  EXPECT_LE(std::filesystem::file_size(logs / "loud.log"), 1'000'000U);
}

}  // namespace
}  // namespace coop::test
