#include "amcl/free_space.hpp"

#include <gtest/gtest.h>

namespace coop::amcl {
namespace {

TEST(FreeSpace, DrawsOnlyFromFreeCellsAndFromAllOfThem) {
  OccupancyGrid map({4, 3, 0.5, {-1, 2}}, kOccupied);
  map[{0, 0}] = kFree;
  map[{3, 2}] = 20;
  map[{2, 1}] = kUnknown;
  map[{1, 1}] = 50;
  const FreeSpace space(map);
  EXPECT_DOUBLE_EQ(space.area(), 0.5);
  RandomStream random(1, "test");
  int first = 0;
  double sum_of_headings = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const Pose2 pose = space.draw(random);
    const Cell cell = map.geometry.cell_of(pose.position());
    ASSERT_TRUE(cell == (Cell{0, 0}) || cell == (Cell{3, 2}));
    first += cell == Cell{0, 0} ? 1 : 0;
    sum_of_headings += pose.yaw;
  }
  EXPECT_NEAR(first, 5000, 200);
  EXPECT_NEAR(sum_of_headings / 10000, 0.0, 0.08);
}

TEST(FreeSpace, IsEmptyWhereTheMapHasNoFreeCell) {
  EXPECT_TRUE(FreeSpace(OccupancyGrid({4, 4, 0.1, {0, 0}}, kUnknown)).empty());
}

}  // namespace
}  // namespace coop::amcl
