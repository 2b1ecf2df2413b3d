#include "global_planner/pose_checker.hpp"

#include <gtest/gtest.h>

#include "unit/global_planner/drawn_map.hpp"

namespace coop::global_planner {
namespace {

/// 6 m x 3 m, a wall along y < 0.5 m.
DistanceField field_with_wall() {
  const GridGeometry grid{120, 60, 0.05, {0.0, 0.0}};
  std::vector<std::uint8_t> cells(grid.size(), 0);
  for (int x = 0; x < grid.width; ++x) {
    for (int y = 0; y < 10; ++y) cells[grid.index({x, y})] = 1;
  }
  DistanceField field;
  field.update(grid, cells, 1.5);
  return field;
}

constexpr PoseCheckerConfig kConfig{
    .padding = 0.15, .tight_padding = 0.05, .escape_padding = -0.05, .tight_distance = 0.5};

/// Robot along the wall with its flank that far from it.
Pose2 beside_wall(double x, double gap) {
  return {x, 0.5 + 0.28 + gap, 0.0};
}

class PoseCheckerTest : public testing::Test {
 protected:
  DistanceField field_ = field_with_wall();
  PoseChecker checker_{kConfig, test::kRobotFootprint, 0.05};
};

TEST_F(PoseCheckerTest, AsksForTheFullPaddingOnTheWay) {
  ASSERT_TRUE(checker_.prepare(field_, {1, 2, 0}, {4, 2, 0}));
  EXPECT_TRUE(checker_.free(beside_wall(2.5, 0.25)));
  EXPECT_FALSE(checker_.free(beside_wall(2.5, 0.10)));
}

TEST_F(PoseCheckerTest, IsContentWithLessNearAStartThatLeavesNoRoom) {
  ASSERT_TRUE(checker_.prepare(field_, beside_wall(1.0, 0.10), {4, 2, 0}));
  EXPECT_TRUE(checker_.free(beside_wall(1.3, 0.10)));
  EXPECT_FALSE(checker_.free(beside_wall(1.6, 0.10)));
}

TEST_F(PoseCheckerTest, IsContentWithLessNearAGoalThatLeavesNoRoom) {
  ASSERT_TRUE(checker_.prepare(field_, {1, 2, 0}, beside_wall(4.0, 0.10)));
  EXPECT_TRUE(checker_.free(beside_wall(3.7, 0.10)));
  EXPECT_FALSE(checker_.free(beside_wall(3.0, 0.10)));
}

TEST_F(PoseCheckerTest, LetsARobotEscapeThatTouchesTheWall) {
  ASSERT_TRUE(checker_.prepare(field_, beside_wall(1.0, -0.03), {4, 2, 0}));
  EXPECT_TRUE(checker_.free(beside_wall(1.1, -0.02)));
}

TEST_F(PoseCheckerTest, RefusesAStartDeepInTheWall) {
  const auto result = checker_.prepare(field_, beside_wall(1.0, -0.30), {4, 2, 0});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), PoseFailure::kStartBlocked);
}

TEST_F(PoseCheckerTest, RefusesAGoalThatTouchesTheWall) {
  const auto result = checker_.prepare(field_, {1, 2, 0}, beside_wall(4.0, -0.02));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), PoseFailure::kGoalBlocked);
}

}  // namespace
}  // namespace coop::global_planner
