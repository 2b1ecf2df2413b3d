#include "capture/traffic/kept_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.hpp"

namespace coop::capture {
namespace {

class KeptFiles : public ::testing::Test {
 protected:
  /// The n-th file, each a second younger than the one before.
  void make(const std::string& name) {
    const auto path = folder_.path() / name;
    std::ofstream(path) << "x";
    std::filesystem::last_write_time(path, begin_ + std::chrono::seconds(made_++));
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      all.push_back(entry.path().filename().string());
    }
    return all;
  }
  test::TemporaryFolder folder_;
  std::filesystem::file_time_type begin_ = std::filesystem::file_time_type::clock::now();
  int made_ = 0;
};

TEST_F(KeptFiles, AreTheNewestOfTheirKindAndAllOthers) {
  make("record-3-fault.mcap");  // the oldest, whatever its name says
  make("record-1-fault.mcap");
  make("record-2-snapshot.mcap");
  make("record-2-fault-2.mcap");
  make("record-2.mcap");
  make("other-1-fault.mcap");
  make("record-notes-fault.txt");
  keep_newest(folder_.path(), "record-", "-fault", {.count = 2});
  EXPECT_THAT(names(), ::testing::UnorderedElementsAre(
                           "record-1-fault.mcap", "record-2-fault-2.mcap", "record-2-snapshot.mcap",
                           "record-2.mcap", "other-1-fault.mcap", "record-notes-fault.txt"));
}

TEST_F(KeptFiles, AreNoMoreBytesThanAllowed) {
  for (const char* name : {"record-1-fault.mcap", "record-2-fault.mcap", "record-3-fault.mcap"}) {
    make(name);
  }
  EXPECT_TRUE(keep_newest(folder_.path(), "record-", "-fault", {.bytes = 2}));
  EXPECT_THAT(names(),
              ::testing::UnorderedElementsAre("record-2-fault.mcap", "record-3-fault.mcap"));
  EXPECT_TRUE(keep_newest(folder_.path(), "record-", "-fault", {.bytes = 0}));
  EXPECT_THAT(names(), ::testing::IsEmpty());
}

TEST_F(KeptFiles, GoWhereTheDiskNeedsTheRoomUnlessThatDoesNotHelp) {
  make("record-1-fault.mcap");
  make("record-2-fault.mcap");
  const auto free = std::filesystem::space(folder_.path()).available;
  // As long as the disk has room, and it takes none: a hole.
  std::filesystem::resize_file(folder_.path() / "record-1-fault.mcap", free);
  EXPECT_FALSE(keep_newest(folder_.path(), "record-", "-fault", {.free_bytes = 4 * free}));
  EXPECT_THAT(names(), ::testing::SizeIs(2)) << "they would be lost in vain";
  EXPECT_TRUE(keep_newest(folder_.path(), "record-", "-fault", {.free_bytes = free / 2}));
  EXPECT_THAT(names(), ::testing::SizeIs(2)) << "there is room";
  EXPECT_TRUE(keep_newest(folder_.path(), "record-", "-fault", {.free_bytes = free / 2 * 3}));
  EXPECT_THAT(names(), ::testing::ElementsAre("record-2-fault.mcap"));
}

TEST_F(KeptFiles, AreAllWhereThereAreFewAndNoneWhereThereIsNoFolder) {
  make("record-1-fault.mcap");
  keep_newest(folder_.path(), "record-", "-fault", {.count = 2});
  EXPECT_THAT(names(), ::testing::ElementsAre("record-1-fault.mcap"));
  keep_newest(folder_.path() / "none", "record-", "-fault", {.count = 2});
}

}  // namespace
}  // namespace coop::capture
