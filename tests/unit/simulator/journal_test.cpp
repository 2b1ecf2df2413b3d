#include "simulator/journal.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/atomic_file.hpp"
#include "simulator/archive.hpp"
#include "support/temporary_folder.hpp"

namespace coop::simulator {
namespace {

class JournalTest : public testing::Test {
 protected:
  void flip_byte_at(std::size_t offset) {
    std::string content = read_file(path_);
    content.at(offset) = static_cast<char>(~content.at(offset));
    std::ofstream(path_, std::ios::binary) << content;
  }

  coop::test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "run" / "simulator.journal";
};

TEST_F(JournalTest, HoldsNothingBeforeTheFirstRecord) {
  EXPECT_FALSE(Journal::newest(path_).has_value());
  const Journal journal(path_, 100);
  EXPECT_FALSE(Journal::newest(path_).has_value());
}

TEST_F(JournalTest, TheNewestRecordIsRead) {
  Journal journal(path_, 100);
  for (const char* record : {"one", "two", "three"}) {
    journal.write(record);
    EXPECT_EQ(Journal::newest(path_), record);
  }
}

TEST_F(JournalTest, ATornRecordLeavesTheOneBefore) {
  Journal journal(path_, 100);
  journal.write("one");    // slot 1
  journal.write("two");    // slot 0
  journal.write("three");  // slot 1
  const std::size_t half = read_file(path_).size() / 2;
  flip_byte_at(half + 34);  // within "three"
  EXPECT_EQ(Journal::newest(path_), "two");
  flip_byte_at(34);
  EXPECT_FALSE(Journal::newest(path_).has_value());
}

TEST_F(JournalTest, ANewJournalGoesOnWhereTheOldOneEnded) {
  { Journal(path_, 100).write("one"); }
  { Journal(path_, 100).write("two"); }
  EXPECT_EQ(Journal::newest(path_), "two");
  Journal third(path_, 100);
  EXPECT_EQ(Journal::newest(path_), "two");
  third.write("three");
  EXPECT_EQ(Journal::newest(path_), "three");
}

TEST_F(JournalTest, AFileOfAnotherSizeIsStartedAnew) {
  { Journal(path_, 100).write("one"); }
  const Journal larger(path_, 200);
  EXPECT_FALSE(Journal::newest(path_).has_value());
}

TEST_F(JournalTest, GarbageIsNoRecord) {
  write_file_atomically(path_, std::string(264, 'x'));
  EXPECT_FALSE(Journal::newest(path_).has_value());
  Journal journal(path_, 100);
  journal.write("one");
  EXPECT_EQ(Journal::newest(path_), "one");
}

TEST_F(JournalTest, ARecordBeyondTheCapacityIsRefused) {
  Journal journal(path_, 10);
  EXPECT_THROW(journal.write("eleven bytes"), std::length_error);
}

TEST(Archive, GivesBackWhatItWasGiven) {
  int number = 7;
  double tiny = 0x1.0p-1074;
  std::string text = "egg";
  Eigen::Vector3d vector(1, 2, 3);
  std::vector<std::string> list{"a", "bc"};
  std::string bytes;
  ArchiveWriter writer(bytes);
  writer(number, tiny, text, vector, list);

  int number2 = 0;
  double tiny2 = 0;
  std::string text2;
  Eigen::Vector3d vector2;
  std::vector<std::string> list2;
  ArchiveReader reader(bytes);
  reader(number2, tiny2, text2, vector2, list2);
  EXPECT_EQ(number2, 7);
  EXPECT_EQ(tiny2, tiny);
  EXPECT_EQ(text2, "egg");
  EXPECT_EQ(vector2, vector);
  EXPECT_EQ(list2, list);
  EXPECT_TRUE(reader.at_end());
}

TEST(Archive, BytesThatEndTooEarlyAreAnError) {
  ArchiveReader reader("abc");
  double value = 0;
  EXPECT_THROW(reader(value), std::runtime_error);
  const std::string huge(8, '\x7f');
  ArchiveReader damaged(huge);
  std::string text;
  EXPECT_THROW(damaged(text), std::runtime_error);
}

}  // namespace
}  // namespace coop::simulator
