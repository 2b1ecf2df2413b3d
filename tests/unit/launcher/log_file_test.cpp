#include "launcher/log_file.hpp"

#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "launcher/log_tail.hpp"
#include "support/temporary_folder.hpp"

namespace coop::launcher {
namespace {

constexpr double kBytes = 1e-6;  ///< MB

class LogFileTest : public ::testing::Test {
 protected:
  std::string content(const std::string& suffix = "") {
    const auto file = path_.string() + suffix;
    return std::filesystem::exists(file) ? read_file(file) : "absent";
  }
  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "dwa.log";
};

TEST_F(LogFileTest, AFileThatWouldGrowTooLargeIsRotatedAndTheOldestGoes) {
  LogFile log(path_, 10 * kBytes, 2);
  for (const char* text : {"1111111\n", "2222222\n", "3333333\n", "4444444\n"}) log.append(text);
  EXPECT_EQ(content(), "4444444\n");
  EXPECT_EQ(content(".1"), "3333333\n");
  EXPECT_EQ(content(".2"), "2222222\n");
  EXPECT_EQ(content(".3"), "absent");
}

TEST_F(LogFileTest, WithoutOldFilesOnlyTheNewestStays) {
  LogFile log(path_, 10 * kBytes, 0);
  log.append("1111111\n");
  log.append("2222222\n");
  EXPECT_EQ(content(), "2222222\n");
  EXPECT_EQ(content(".1"), "absent");
}

TEST_F(LogFileTest, ASecondStartOfTheComponentGoesOnInTheSameFile) {
  LogFile(path_, 1.0, 1).append("first\n");
  LogFile(path_, 1.0, 1).append("second\n");
  EXPECT_EQ(content(), "first\nsecond\n");
}

TEST_F(LogFileTest, TheLastLineIsFoundAcrossPiecesAndBlankLines) {
  LogFile log(path_, 1.0, 1);
  EXPECT_EQ(log.last_line(), "");
  log.append("starting\nassertion ");
  EXPECT_EQ(log.last_line(), "assertion ");
  log.append("failed\n\n  \n");
  EXPECT_EQ(log.last_line(), "assertion failed");
  log.append(std::string(100000, 'x') + "\n");
  EXPECT_EQ(log.last_line(), std::string(300, 'x'));
}

TEST_F(LogFileTest, WhatCannotBeWrittenIsCountedAndSaidLater) {
  std::filesystem::create_symlink("/dev/full", path_);
  LogFile log(path_, 1.0, 1);
  log.append("lost line\n");
  EXPECT_EQ(log.lost_bytes(), 10U);
  EXPECT_EQ(log.last_line(), "lost line");
}

TEST_F(LogFileTest, TheTailShowsTheLastLinesAndThenWhatComes) {
  LogFile log(path_, 1.0, 1);
  log.append("a\nb\nc\n");
  LogTail tail(path_);
  EXPECT_EQ(tail.last_lines(2), "b\nc\n");
  EXPECT_EQ(tail.more(), "");
  log.append("d\n");
  EXPECT_EQ(tail.more(), "d\n");
  EXPECT_EQ(LogTail(path_).last_lines(0), "a\nb\nc\nd\n");
  EXPECT_EQ(LogTail(path_).last_lines(99), "a\nb\nc\nd\n");
}

TEST_F(LogFileTest, TheTailFollowsARotation) {
  LogFile log(path_, 10 * kBytes, 1);
  log.append("1111111\n");
  LogTail tail(path_);
  EXPECT_EQ(tail.last_lines(1), "1111111\n");
  log.append("22\n");  // rotates
  log.append("33\n");
  EXPECT_EQ(tail.more(), "22\n33\n");
}

}  // namespace
}  // namespace coop::launcher
