#include "core/state_journal.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace coop {
namespace {

class StateJournalTest : public testing::Test {
 protected:
  void flip_byte_at(std::size_t offset) {
    std::string content = read_file(path_);
    content.at(offset) = static_cast<char>(~content.at(offset));
    std::ofstream(path_, std::ios::binary) << content;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "run" / "state.journal";
};

TEST_F(StateJournalTest, HoldsNothingBeforeTheFirstRecord) {
  EXPECT_FALSE(StateJournal::newest(path_).has_value());
  const StateJournal journal(path_, 100);
  EXPECT_FALSE(StateJournal::newest(path_).has_value());
}

TEST_F(StateJournalTest, TheNewestRecordIsRead) {
  StateJournal journal(path_, 100);
  for (const char* record : {"one", "two", "three"}) {
    journal.write(record);
    EXPECT_EQ(StateJournal::newest(path_), record);
  }
}

TEST_F(StateJournalTest, ATornRecordLeavesTheOneBefore) {
  StateJournal journal(path_, 100);
  journal.write("one");    // slot 1
  journal.write("two");    // slot 0
  journal.write("three");  // slot 1
  const std::size_t half = read_file(path_).size() / 2;
  flip_byte_at(half + 34);  // within "three"
  EXPECT_EQ(StateJournal::newest(path_), "two");
  flip_byte_at(34);
  EXPECT_FALSE(StateJournal::newest(path_).has_value());
}

TEST_F(StateJournalTest, ANewJournalGoesOnWhereTheOldOneEnded) {
  { StateJournal(path_, 100).write("one"); }
  { StateJournal(path_, 100).write("two"); }
  EXPECT_EQ(StateJournal::newest(path_), "two");
  StateJournal third(path_, 100);
  EXPECT_EQ(StateJournal::newest(path_), "two");
  third.write("three");
  EXPECT_EQ(StateJournal::newest(path_), "three");
}

TEST_F(StateJournalTest, AFileOfAnotherSizeIsStartedAnew) {
  { StateJournal(path_, 100).write("one"); }
  const StateJournal larger(path_, 200);
  EXPECT_FALSE(StateJournal::newest(path_).has_value());
}

TEST_F(StateJournalTest, GarbageIsNoRecord) {
  write_file_atomically(path_, std::string(264, 'x'));
  EXPECT_FALSE(StateJournal::newest(path_).has_value());
  StateJournal journal(path_, 100);
  journal.write("one");
  EXPECT_EQ(StateJournal::newest(path_), "one");
}

TEST_F(StateJournalTest, ARecordBeyondTheCapacityIsRefused) {
  StateJournal journal(path_, 10);
  EXPECT_THROW(journal.write("eleven bytes"), std::length_error);
}

}  // namespace
}  // namespace coop
