// Coming up, and refusing to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "launcher/supervisor.hpp"
#include "system/launcher/launch_text.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

RunningSystem::Result run_to_end(const std::filesystem::path& launch_file,
                                 std::vector<std::string> more = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"up",        launch_file.string(),
                                     "--domain",  std::to_string(test_domain()),
                                     "--run-dir", (folder.path() / "runs").string(),
                                     "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto result = run_launcher(arguments, folder.path());
  const auto runs = folder.path() / "runs";
  if (result.code == launcher::kExitBadLaunch || result.code == launcher::kExitInUse) {
    EXPECT_TRUE(!std::filesystem::exists(runs) || std::filesystem::is_empty(runs))
        << "a launch that never started left a run folder";
  }
  return result;
}

long lines_of(const std::string& text) {
  return std::ranges::count(text, '\n');
}

TEST(LauncherStartTest, ComponentsStartInOrderAndTheirOutputIsKept) {
  LaunchText launch;
  RunningSystem system(launch.add("b", "", "after: [a]").add("a").file(), {"--set", "seed=5"});
  ASSERT_TRUE(system.wait_until_ready()) << system.launcher().output();
  const auto view = system.view();
  EXPECT_EQ(view->rows[0].name, "a");
  EXPECT_EQ(view->rows[1].name, "b");
  EXPECT_GT(view->rows[0].resident, 1'000'000U);
  EXPECT_EQ(system.stop().value().code, 0);
  EXPECT_THAT(read_file(system.run_folder() / "logs" / "a.log"),
              HasSubstr("fake component a starts\n"));
  EXPECT_THAT(read_file(system.run_folder() / "launch.yaml"), HasSubstr("seed: 5"));
  EXPECT_THAT(read_file(system.run_folder() / "launcher.log"), HasSubstr("all 2 components ready"));
  EXPECT_THAT(system.launcher().output(),
              ContainsRegex("a: started.*\n.*a: ready after .*\n.*b: started"));
}

TEST(LauncherStartTest, ADegradedComponentLetsOthersStartAndSaysWhatItLacks) {
  LaunchText launch;
  RunningSystem system(launch.add("a", "behaviour: degraded").add("b", "", "after: [a]").file());
  ASSERT_TRUE(system.wait_for_state("b", "ready"));
  EXPECT_EQ(system.row("a").value().state, "degraded");
  EXPECT_EQ(system.row("a").value().detail, "no input");
}

TEST(LauncherStartTest, AMisspeltParameterIsOneLineWithFileAndLineAndNothingStarts) {
  LaunchText launch;
  const auto result = run_to_end(launch.add("a").add("b", "behaviuor: run").file());
  EXPECT_EQ(result.code, launcher::kExitBadLaunch);
  EXPECT_EQ(lines_of(result.output), 1) << result.output;
  EXPECT_THAT(result.output, ContainsRegex("launcher: .*test.yaml:3: b: .*unknown key "
                                           "'behaviuor'; did you mean 'behaviour'"));
}

TEST(LauncherStartTest, ABadOverrideIsOneLine) {
  LaunchText launch;
  const auto file = launch.add("a").file();
  const auto unknown = run_to_end(file, {"--set", "aa.delay=1"});
  EXPECT_EQ(unknown.code, launcher::kExitBadLaunch);
  EXPECT_EQ(unknown.output,
            "launcher: --set aa.delay=1: no component, variable or launch key 'aa'; did you mean "
            "'a'?\n");
  const auto wrong = run_to_end(file, {"--set", "a.delay=soon"});
  EXPECT_EQ(wrong.code, launcher::kExitBadLaunch);
  EXPECT_EQ(lines_of(wrong.output), 1);
  EXPECT_THAT(wrong.output, HasSubstr("delay: expected a number, got 'soon'"));
}

TEST(LauncherStartTest, AMissingFileIsOneLine) {
  const auto result = run_to_end("no/such/launch.yaml");
  EXPECT_EQ(result.code, launcher::kExitBadLaunch);
  EXPECT_EQ(result.output, "launcher: no launch file 'no/such/launch.yaml'\n");
  LaunchText launch;
  const auto config = run_to_end(launch.add("a", "", "config: gone.yaml").file());
  EXPECT_EQ(config.code, launcher::kExitBadLaunch);
  EXPECT_EQ(lines_of(config.output), 1);
  EXPECT_THAT(config.output, HasSubstr("test.yaml:2: a: config: no file 'gone.yaml'"));
}

TEST(LauncherStartTest, ASecondLauncherOnTheSameDomainIsRefusedAndTheFirstGoesOn) {
  LaunchText launch;
  RunningSystem system(launch.add("a").file());
  ASSERT_TRUE(system.wait_until_ready());
  const pid_t before = system.row("a").value().pid;
  LaunchText other;
  const auto result = run_to_end(other.add("x").file());
  EXPECT_EQ(result.code, launcher::kExitInUse);
  EXPECT_EQ(result.output,
            "launcher: domain " + std::to_string(system.domain()) +
                " is in use by another launcher, pid " + std::to_string(system.launcher().pid()) +
                "; stop it with `coop down` or choose another domain with --domain\n");
  ASSERT_TRUE(system.wait_until_ready());
  EXPECT_EQ(system.row("a").value().pid, before);
}

TEST(LauncherStartTest, AComponentThatRunsWithoutOurLauncherIsFoundByItsHeartbeat) {
  const TemporaryFolder folder;
  const std::string domain = std::to_string(test_domain());
  Program stranger(COOP_FAKE_COMPONENT, {"--name", "a", "--domain", domain},
                   folder.path() / "stranger.out");
  ASSERT_TRUE(wait_until([&] { return stranger.output().find("starts") != std::string::npos; }));
  LaunchText launch;
  const auto result = run_to_end(launch.add("a").file());
  EXPECT_EQ(result.code, launcher::kExitInUse);
  EXPECT_EQ(lines_of(result.output), 1);
  EXPECT_THAT(result.output, HasSubstr("a component 'a' already runs there, pid " +
                                       std::to_string(stranger.pid())));
}

TEST(LauncherStartTest, RobotsOfDifferentNamesShareADomain) {
  LaunchText launch;
  RunningSystem system(launch.add("a").file(), {"--robot", "ducky"});
  ASSERT_TRUE(system.wait_until_ready());
  LaunchText other;
  const auto result = run_to_end(other.add("a").file(),
                                 {"--robot", "goose", "--until", "ready", "--timeout", "20"});
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_TRUE(system.wait_until_ready());
}

}  // namespace
}  // namespace coop::test
