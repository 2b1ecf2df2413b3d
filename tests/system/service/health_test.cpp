// `coop health` of a running system, and how long a system takes to come up and to go.
#include <gtest/gtest.h>

#include <csignal>
#include <iostream>

#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

const std::filesystem::path kLaunch = std::filesystem::path(COOP_SOURCE_DIR) / "config/launch";
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

struct HealthAnswer {
  int code = -1;
  std::string text;
};

HealthAnswer health(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  arguments.insert(arguments.end(), {"--domain", std::to_string(test_domain())});
  Program program("health", arguments, folder.path() / "output");
  const auto status = program.wait();
  return {status ? status->code : -1, program.output()};
}

TEST(Health, TellsOfEachComponentWhetherItIsReadyStoppedOrGone) {
  RunningSystem system(kLaunch / "drive.yaml", {"--set", "lockstep=false", "--set", "rate=1"});
  ASSERT_TRUE(wait_until([] { return health({"dwa"}).code == 0; }));
  EXPECT_EQ(health({"dwaa"}).code, 5);
  EXPECT_EQ(health({"dwaa"}).text, "dwaa: absent\n");
  EXPECT_EQ(health({"dwa", "--robot", "another"}).code, 5);

  const auto row = system.row("simulator");
  ASSERT_TRUE(row);
  kill(row->pid, SIGSTOP);
  const auto stopped = Clock::now();
  ASSERT_TRUE(wait_until([] { return health({"simulator"}).code == 4; }));
  std::cout << "stopped to stale: " << seconds_since(stopped) << " s\n";
  EXPECT_TRUE(health({"simulator"}).text.starts_with("simulator: stale: silent for "));
  kill(row->pid, SIGCONT);
  EXPECT_TRUE(wait_until([] { return health({"simulator"}).code == 0; }));

  system.stop();
  EXPECT_EQ(health({"dwa"}).code, 5);
  EXPECT_EQ(health({}).text, "all: absent\n");
}

TEST(Health, ASystemComesUpAndGoesWithoutLeavingAnything) {
  const auto begin = Clock::now();
  RunningSystem system(kLaunch / "sim.yaml");
  ASSERT_TRUE(system.wait_until_ready());
  std::cout << "up to all ready: " << seconds_since(begin) << " s\n";
  EXPECT_EQ(health({}).code, 0) << health({}).text;
  const std::vector<pid_t> pids = system.pids();
  const auto asked = Clock::now();
  EXPECT_EQ(system.command({"down"}).code, 0);
  std::cout << "down: " << seconds_since(asked) << " s\n";
  ASSERT_TRUE(system.launcher().wait());
  for (const pid_t pid : pids) EXPECT_FALSE(is_alive(pid)) << pid;
  EXPECT_TRUE(std::filesystem::is_empty(control_folder())) << "neither sockets nor states are left";
}

}  // namespace
}  // namespace coop::test
