#include "global_planner/path_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coop::global_planner {
namespace {

TraversalGrid open_grid() {
  TraversalGrid grid{TraversalConfig{}};
  grid.update(Grid<Cost>({20, 20, 0.1, {0.0, 0.0}}, kFreeCost));
  return grid;
}

TEST(Smooth, KeepsTheEndsAndLeavesAStraightLineAlone) {
  const std::vector<Eigen::Vector2d> line{{0.15, 0.15}, {0.25, 0.15}, {0.35, 0.15}};
  const auto smoothed = smooth(open_grid(), line);
  for (std::size_t i = 0; i < line.size(); ++i)
    EXPECT_NEAR((smoothed[i] - line[i]).norm(), 0, 1e-9);
}

TEST(Smooth, PullsACornerInwards) {
  const std::vector<Eigen::Vector2d> corner{
      {0.15, 0.15}, {0.25, 0.15}, {0.35, 0.15}, {0.35, 0.25}, {0.35, 0.35}};
  const auto smoothed = smooth(open_grid(), corner);
  EXPECT_LT(smoothed[2].x(), 0.35);
  EXPECT_GT(smoothed[2].y(), 0.15);
  EXPECT_EQ(smoothed.front(), corner.front());
  EXPECT_EQ(smoothed.back(), corner.back());
}

TEST(Smooth, DoesNotMoveAPointToADearerCell) {
  Grid<Cost> costs({20, 20, 0.1, {0.0, 0.0}}, kFreeCost);
  costs[{2, 2}] = kLethalCost;
  TraversalGrid grid{TraversalConfig{}};
  grid.update(costs);
  const std::vector<Eigen::Vector2d> corner{{0.15, 0.11}, {0.35, 0.11}, {0.35, 0.35}};
  for (const Eigen::Vector2d& point : smooth(grid, corner)) {
    EXPECT_FALSE(grid.geometry().cell_of(point) == (Cell{2, 2}));
  }
}

TEST(Orient, SpacesPosesEvenlyAndTurnsThemAlongThePath) {
  const auto poses = orient({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, 0.25, 0.3);
  ASSERT_EQ(poses.size(), 9U);
  EXPECT_NEAR(poses[1].x, 0.25, 1e-9);
  EXPECT_NEAR(poses[1].yaw, 0.0, 1e-9);
  EXPECT_NEAR(poses[6].y, 0.5, 1e-9);
  EXPECT_NEAR(poses[6].yaw, std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(poses.back(), (Pose2{1.0, 1.0, 0.3}));
}

}  // namespace
}  // namespace coop::global_planner
