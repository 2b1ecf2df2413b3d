#include "core/child_process.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <system_error>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop {
namespace {

TEST(ChildProcess, its_output_and_exit_code_come_back) {
  const test::TemporaryFolder folder;
  ChildProcess child({"/bin/sh", "-c", "echo out; echo err >&2; exit 3"}, folder.path() / "log");
  EXPECT_EQ(child.wait(), 3);
  EXPECT_EQ(child.poll(), 3);
  EXPECT_EQ(read_file(folder.path() / "log"), "out\nerr\n");
}

TEST(ChildProcess, one_that_is_asked_to_stop_ends_by_that_signal) {
  const test::TemporaryFolder folder;
  ChildProcess child({"/bin/sleep", "1000"}, folder.path() / "log");
  EXPECT_FALSE(child.poll());
  child.ask_to_stop();
  EXPECT_EQ(child.wait(), 128 + SIGTERM);
}

TEST(ChildProcess, has_a_process_group_of_its_own) {
  const test::TemporaryFolder folder;
  ChildProcess child({"/bin/sh", "-c", "ps -o pgid= -p $$ | tr -d ' '"}, folder.path() / "log");
  EXPECT_EQ(child.wait(), 0);
  EXPECT_NE(read_file(folder.path() / "log"), std::to_string(::getpgrp()) + "\n");
}

TEST(ChildProcess, a_program_that_is_not_there_is_told) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(ChildProcess({"/no/such/program"}, folder.path() / "log"), std::system_error);
}

}  // namespace
}  // namespace coop
