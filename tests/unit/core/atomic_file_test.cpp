#include "core/atomic_file.hpp"

#include <gtest/gtest.h>

#include <system_error>

#include "support/temporary_folder.hpp"

namespace coop {
namespace {

TEST(AtomicFileTest, WhatIsWrittenIsReadAndReplacesTheOldWhole) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "deep" / "map.yaml";
  write_file_atomically(path, "a longer first content");
  write_file_atomically(path, "second");
  EXPECT_EQ(read_file(path), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

TEST(AtomicFileTest, AFullDiskIsAnErrorThatNamesTheFile) {
  try {
    write_file_atomically("/dev/full/x", "content");
    FAIL() << "no error";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("/dev/full"), std::string::npos);
  }
}

TEST(AtomicFileTest, AMissingFileIsAnErrorThatNamesTheFile) {
  EXPECT_THROW((void)read_file("/nonexistent/file"), std::system_error);
}

}  // namespace
}  // namespace coop
