#include "launcher/process_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "core/atomic_file.hpp"
#include "launcher/process_usage.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// Real processes: small shell scripts.
class ProcessTableTest : public ::testing::Test {
 protected:
  PlannedComponent script(const std::string& text) {
    PlannedComponent planned;
    planned.name = "script";
    planned.executable = "/bin/sh";
    planned.arguments = {"-c", text};
    return planned;
  }
  /// Runs the loop until a process has ended.
  std::optional<ProcessTable::Exit> wait_for_exit() {
    const Instant limit = std::chrono::steady_clock::now() + 20s;
    while (std::chrono::steady_clock::now() < limit) {
      auto exits = table_.reap();
      if (!exits.empty()) return exits.front();
      loop_.run_once(limit);
      while (signals_.take()) {
      }
    }
    return std::nullopt;
  }
  /// Runs the loop until the process has printed `text`.
  bool wait_for_output(const std::string& text) {
    const Instant limit = std::chrono::steady_clock::now() + 20s;
    while (log().find(text) == std::string::npos) {
      if (std::chrono::steady_clock::now() > limit) return false;
      loop_.run_once(limit);
    }
    return true;
  }
  std::string log() {
    const auto file = folder_.path() / "script.log";
    return std::filesystem::exists(file) ? read_file(file) : "";
  }

  test::TemporaryFolder folder_;
  SignalFile signals_{SIGCHLD};
  EventLoop loop_;
  std::string echoed_;
  ProcessTable table_{loop_, folder_.path(),
                      [this](const std::string& name, std::string_view data) {
                        echoed_ += name + ": " + std::string(data);
                      }};

  void SetUp() override {
    loop_.watch(signals_.fd(), [] {});
  }
};

TEST_F(ProcessTableTest, OutputExitCodeAndLastWordsAreKept) {
  const auto pid = table_.start(script("echo one; echo two >&2; exit 7"));
  ASSERT_TRUE(pid);
  const auto exit = wait_for_exit();
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->pid, *pid);
  EXPECT_EQ(exit->status.text(), "exit code 7");
  EXPECT_EQ(log(), "one\ntwo\n");
  EXPECT_EQ(table_.last_words("script"), "two");
  EXPECT_EQ(echoed_, "");
}

TEST_F(ProcessTableTest, AProcessHasNoInputItsOwnEnvironmentAndDefaultSignals) {
  auto planned = script("cat; echo \"$DUCK\"; kill -TERM $$; echo survived");
  planned.environment = {"DUCK=quack quack"};
  planned.log.console = true;
  ASSERT_TRUE(table_.start(planned));
  const auto exit = wait_for_exit();
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->status.signal, SIGTERM);
  EXPECT_EQ(exit->status.text(), "killed by signal 15 (Terminated)");
  EXPECT_EQ(log(), "quack quack\n");
  EXPECT_EQ(echoed_, "script: quack quack\n");
}

TEST_F(ProcessTableTest, NoFileOfOursIsOpenInAProcess) {
  ASSERT_TRUE(table_.start(script("ls /proc/self/fd | wc -l")));
  ASSERT_TRUE(wait_for_exit());
  EXPECT_EQ(log(), "4\n");  // 0, 1, 2 and the folder ls reads
}

TEST_F(ProcessTableTest, ASignalReachesTheWholeGroup) {
  const auto pid = table_.start(script("sleep 1000 & echo ready; wait"));
  ASSERT_TRUE(pid);
  ASSERT_TRUE(wait_for_output("ready"));
  table_.signal(*pid, SIGKILL);
  const auto exit = wait_for_exit();
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->status.signal, SIGKILL);
  // The pipe closes only when the last of the group is gone; a new start waits for nothing.
  ASSERT_TRUE(table_.start(script("echo again")));
  ASSERT_TRUE(wait_for_exit());
  EXPECT_THAT(log(), HasSubstr("again"));
}

TEST_F(ProcessTableTest, WhatCannotBeExecutedSaysWhy) {
  auto planned = script("");
  planned.executable = "/no/such/program";
  const auto pid = table_.start(planned);
  ASSERT_FALSE(pid);
  EXPECT_EQ(pid.error(), "cannot execute /no/such/program: No such file or directory");
}

TEST_F(ProcessTableTest, ALotOfOutputBeforeDeathIsNotLost) {
  auto planned =
      script("i=0; while [ $i -lt 20000 ]; do echo 0123456789; i=$((i+1)); done; kill -KILL $$");
  ASSERT_TRUE(table_.start(planned));
  ASSERT_TRUE(wait_for_exit());
  EXPECT_EQ(log().size(), 220000U);
}

TEST_F(ProcessTableTest, UseOfProcessorAndMemoryIsMeasured) {
  const auto pid = table_.start(script("while :; do :; done"));
  ASSERT_TRUE(pid);
  UsageMeter meter;
  const Instant begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(meter.sample(*pid, begin));
  std::optional<Usage> later;
  do {
    loop_.run_once(std::chrono::steady_clock::now() + 50ms);
    later = meter.sample(*pid, std::chrono::steady_clock::now());
  } while (later && later->cpu == 0.0 && std::chrono::steady_clock::now() < begin + 20s);
  ASSERT_TRUE(later);
  EXPECT_GT(later->cpu_seconds, 0.0);
  EXPECT_GT(later->cpu, 0.0);
  EXPECT_GT(later->resident, 100'000U);
  table_.signal(*pid, SIGKILL);
  ASSERT_TRUE(wait_for_exit());
  EXPECT_FALSE(meter.sample(*pid, std::chrono::steady_clock::now()));
}

}  // namespace
}  // namespace coop::launcher
