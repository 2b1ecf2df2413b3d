#include "core/search/theta_star.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/search/dijkstra.hpp"
#include "core/search/line_cost.hpp"
#include "support/traversal_drawing.hpp"

namespace coop {
namespace {

using test::draw;
using test::make_grid;

TEST(LineCost, IsTheLengthInTheOpen) {
  const TraversalGrid grid = make_grid(draw({"....",  //
                                             "....",  //
                                             "...."}));
  EXPECT_NEAR(line_cost(grid, {0, 0}, {3, 0}), 3.0, 1e-12);
  EXPECT_NEAR(line_cost(grid, {0, 2}, {2, 0}), 2.0 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(line_cost(grid, {3, 2}, {0, 0}), std::sqrt(13.0), 1e-12);
  EXPECT_EQ(line_cost(grid, {1, 1}, {1, 1}), 0.0);
}

TEST(LineCost, WeighsEveryCellWithTheLengthInIt) {
  const TraversalGrid grid = make_grid(draw({"....",  //
                                             ".9.."}),
                                       {.restricted_weight = 6.0});
  EXPECT_NEAR(line_cost(grid, {0, 0}, {2, 0}), 0.5 + 7.0 + 0.5, 1e-6);
  // Two cells up one: it leaves the first cell's row halfway through (1, 0).
  EXPECT_NEAR(line_cost(grid, {0, 0}, {2, 1}), std::sqrt(5.0) * (0.25 + 0.25 * 7.0 + 0.5), 1e-6);
}

TEST(LineCost, IsInfiniteThroughBlockedCellsAndBlockedCorners) {
  const TraversalGrid grid = make_grid(draw({"..#.",  //
                                             ".#.."}));
  EXPECT_TRUE(std::isinf(line_cost(grid, {0, 0}, {2, 0})));
  EXPECT_TRUE(std::isinf(line_cost(grid, {0, 0}, {1, 1})));
  EXPECT_TRUE(std::isinf(line_cost(grid, {1, 1}, {2, 0})));
  EXPECT_TRUE(std::isinf(line_cost(grid, {2, 0}, {3, 1})));
}

TEST(LineCost, EndsWhereTheLimitIsPassed) {
  const TraversalGrid grid = make_grid(draw({"...."}));
  EXPECT_EQ(line_cost(grid, {0, 0}, {3, 0}, 3.0), 3.0);
  EXPECT_TRUE(std::isinf(line_cost(grid, {0, 0}, {3, 0}, 2.9)));
}

TEST(LineCost, IsThatOfASampledLine) {
  RandomStream random(8, "line_cost_test");
  const Grid<Cost> costs = test::random_costs(random, 40, 40, 0.0, true);
  const TraversalGrid grid = make_grid(costs);
  for (int trial = 0; trial < 50; ++trial) {
    const Cell a = costs.geometry.cell_at(random.below(costs.cells.size()));
    const Cell b = costs.geometry.cell_at(random.below(costs.cells.size()));
    const Eigen::Vector2d from = costs.geometry.center_of(a);
    const Eigen::Vector2d line = costs.geometry.center_of(b) - from;
    constexpr int kSamples = 20000;
    double sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const Cell cell = costs.geometry.cell_of(from + (i + 0.5) / kSamples * line);
      sum += grid.factor(grid.padded_index(cell));
    }
    EXPECT_NEAR(line_cost(grid, a, b), sum / kSamples * line.norm(), 0.02);
    EXPECT_NEAR(line_cost(grid, a, b), line_cost(grid, b, a), 1e-9);
  }
}

TEST(ThetaStar, GoesStraightWhereItSeesTheGoal) {
  const TraversalGrid grid = make_grid(draw({".....",  //
                                             ".....",  //
                                             "....."}));
  const auto path = ThetaStar().plan(grid, {0, 0}, {4, 1});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->cells, (std::vector<Cell>{{0, 0}, {4, 1}}));
  EXPECT_NEAR(path->cost, std::sqrt(17.0), 1e-9);
}

TEST(ThetaStar, TurnsAtTheCornersOfAWall) {
  const TraversalGrid grid = test::grid_with_a_wall();
  const auto path = ThetaStar().plan(grid, {0, 0}, {6, 0});
  ASSERT_TRUE(path);
  // Beside the wall's end on either side: (2, 3) and (4, 3).
  EXPECT_NEAR(path->cost, 2.0 * std::sqrt(13.0) + 2.0, 1e-9);
  EXPECT_EQ(path->cells, (std::vector<Cell>{{0, 0}, {2, 3}, {4, 3}, {6, 0}}));
}

TEST(ThetaStar, IsNeverDearerThanDijkstraAndNeverCheaperThanItsOwnLines) {
  RandomStream random(9, "theta_star_test");
  ThetaStar theta_star;
  Dijkstra dijkstra;
  int found = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Grid<Cost> costs =
        test::random_costs(random, 1 + static_cast<int>(random.below(50)),
                           1 + static_cast<int>(random.below(50)), 0.2, trial % 2 == 0);
    const TraversalGrid grid = make_grid(costs);
    const Cell start = costs.geometry.cell_at(random.below(costs.cells.size()));
    const Cell goal = costs.geometry.cell_at(random.below(costs.cells.size()));
    const auto octile = dijkstra.plan(grid, start, goal);
    const auto path = theta_star.plan(grid, start, goal);
    ASSERT_EQ(path.has_value(), octile.has_value());
    if (!path) continue;
    EXPECT_LE(path->cost, octile->cost * (1.0 + 1e-5)) << "trial " << trial;
    double sum = 0.0;
    for (std::size_t i = 1; i < path->cells.size(); ++i) {
      sum += line_cost(grid, path->cells[i - 1], path->cells[i]);
    }
    EXPECT_NEAR(path->cost, sum, 1e-9) << "trial " << trial;
    ++found;
  }
  EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace coop
