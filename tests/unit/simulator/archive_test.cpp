#include "simulator/archive.hpp"

#include <gtest/gtest.h>

namespace coop::simulator {
namespace {

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
