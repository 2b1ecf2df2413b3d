// The commands given from another terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "launcher/unix_socket.hpp"
#include "system/launcher/launch_text.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class LauncherCommandTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(system_.wait_until_ready()) << system_.launcher().output(); }
  [[nodiscard]] std::filesystem::path socket() const {
    return control_folder() / (std::to_string(system_.domain()) + ".sock");
  }
  LaunchText launch_;
  RunningSystem system_{launch_.add("a").add("b", "", "after: [a]").file()};
};

TEST_F(LauncherCommandTest, PsShowsEveryComponent) {
  const auto result = system_.command({"ps"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.output, ContainsRegex("COMPONENT +STATE"));
  EXPECT_THAT(result.output, ContainsRegex("\na +ready +[0-9]+ "));
  EXPECT_THAT(result.output, ContainsRegex("\nb +ready +[0-9]+ "));
}

TEST_F(LauncherCommandTest, RestartReplacesOneAndLeavesTheOtherAlone) {
  const pid_t a = system_.row("a").value().pid;
  const pid_t b = system_.row("b").value().pid;
  const auto result = system_.command({"restart", "a"});
  EXPECT_EQ(result.code, 0) << result.output;
  EXPECT_THAT(result.output, ContainsRegex("a: ready after [0-9.]+ s"));
  EXPECT_NE(system_.row("a").value().pid, a);
  EXPECT_EQ(system_.row("b").value().pid, b);
}

TEST_F(LauncherCommandTest, StopKeepsItDownAndStartBringsItBack) {
  EXPECT_THAT(system_.command({"stop", "b"}).output, HasSubstr("b: stopped"));
  EXPECT_EQ(system_.row("b").value().state, "stopped");
  EXPECT_THAT(system_.command({"start", "b"}).output, HasSubstr("b: ready"));
  const auto again = system_.command({"start", "b"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.output, HasSubstr("b runs already"));
}

TEST_F(LauncherCommandTest, AnUnknownNameIsOneLineWithTheNearest) {
  const auto result = system_.command({"restart", "bb"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.output, "launcher: no component 'bb'; did you mean 'b'?\n");
}

TEST_F(LauncherCommandTest, LogsShowsWhatAComponentHasPrinted) {
  EXPECT_THAT(system_.command({"logs", "a"}).output, HasSubstr("fake component a starts"));
  EXPECT_THAT(system_.command({"logs", "launcher"}).output, HasSubstr("all 2 components ready"));
  const auto wrong = system_.command({"logs", "x"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.output, HasSubstr("there are: launcher, "));
  EXPECT_EQ(system_.command({"logs", "../launcher"}).code, 1);
}

TEST_F(LauncherCommandTest, LogsFollowsWhatComes) {
  Program follower("launcher", {"logs", "a", "-f", "--domain", std::to_string(system_.domain())},
                   system_.folder() / "follower.out");
  ASSERT_TRUE(wait_until([&] { return !follower.output().empty(); }));
  system_.command({"restart", "a"});
  EXPECT_TRUE(wait_until([&] {
    const std::string text = follower.output();
    return text.find("component a stops") < text.rfind("component a starts");
  }));
}

TEST_F(LauncherCommandTest, DownStopsTheSystemAndReturnsWhenItIsGone) {
  const std::vector<pid_t> pids = system_.pids();
  const auto result = system_.command({"down"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.output, ContainsRegex("stopped after [0-9.]+ s"));
  for (const pid_t pid : pids) EXPECT_FALSE(is_alive(pid));
  ASSERT_TRUE(system_.launcher().wait());
  EXPECT_FALSE(std::filesystem::exists(socket()));
  const auto later = system_.command({"ps"});
  EXPECT_EQ(later.code, 1);
  EXPECT_THAT(later.output, HasSubstr("no system runs"));
}

TEST_F(LauncherCommandTest, TheSocketIsForThisUserAlone) {
  struct stat status {};
  ASSERT_EQ(stat(socket().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  ASSERT_EQ(stat(socket().parent_path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
}

TEST_F(LauncherCommandTest, GarbageOnTheSocketHarmsNobody) {
  for (const std::string& garbage : {std::string("\xff\xfe\n"), std::string(100000, 'x'),
                                     std::string("{}\n"), std::string("{\"verb\":\"rm\"}\n")}) {
    auto connection = launcher::connect_unix(socket().string());
    ASSERT_TRUE(connection);
    [[maybe_unused]] const auto count =
        send(connection->get(), garbage.data(), garbage.size(), MSG_NOSIGNAL);
  }
  EXPECT_EQ(system_.command({"ps"}).code, 0);
}

}  // namespace
}  // namespace coop::test
