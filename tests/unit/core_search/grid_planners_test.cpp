#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "core/search/a_star.hpp"
#include "core/search/dijkstra.hpp"
#include "core/search/jump_point.hpp"
#include "core/search/theta_star.hpp"
#include "support/traversal_drawing.hpp"

namespace coop {
namespace {

using test::draw;
using test::make_grid;

/// What holds for every planner of the family.
template <class Planner>
class GridPlanners : public testing::Test {};
using All = testing::Types<Dijkstra, AStar, JumpPoint, ThetaStar>;
TYPED_TEST_SUITE(GridPlanners, All);

/// Those whose paths are optimal among the 8-connected ones.
template <class Planner>
class OctilePlanners : public testing::Test {};
using Octile = testing::Types<Dijkstra, AStar, JumpPoint>;
TYPED_TEST_SUITE(OctilePlanners, Octile);

void expect_valid_steps(const TraversalGrid& grid, const GridPath& path) {
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    const Cell a = path.cells[i - 1];
    const Cell b = path.cells[i];
    EXPECT_EQ(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 1);
    EXPECT_TRUE(grid.passable(b) && grid.passable({a.x, b.y}) && grid.passable({b.x, a.y}));
  }
}

TYPED_TEST(GridPlanners, TellEveryReasonApart) {
  TypeParam planner;
  const TraversalGrid grid = make_grid(draw({"..#.",  //
                                             "..#i"}));
  EXPECT_EQ(planner.plan(grid, {0, 0}, {3, 1}).error(), SearchFailure::kNoPath);
  EXPECT_EQ(planner.plan(grid, {2, 0}, {0, 1}).error(), SearchFailure::kStartBlocked);
  EXPECT_EQ(planner.plan(grid, {0, 0}, {3, 0}).error(), SearchFailure::kGoalBlocked);
  EXPECT_EQ(planner.plan(grid, {0, 0}, {4, 0}).error(), SearchFailure::kGoalOutside);
  EXPECT_EQ(planner.plan(grid, {0, -1}, {0, 0}).error(), SearchFailure::kStartOutside);
  EXPECT_EQ(planner.plan(grid, {0, 0}, {std::numeric_limits<int>::max(), 0}).error(),
            SearchFailure::kGoalOutside);
  EXPECT_EQ(planner.plan(make_grid({}), {0, 0}, {0, 0}).error(), SearchFailure::kEmptyGrid);
  EXPECT_EQ(planner.plan(TraversalGrid(), {0, 0}, {0, 0}).error(), SearchFailure::kEmptyGrid);
}

TYPED_TEST(GridPlanners, StayWhereStartAndGoalAreOneCell) {
  const auto path = TypeParam().plan(make_grid(draw({"."})), {0, 0}, {0, 0});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->cells, (std::vector<Cell>{{0, 0}}));
  EXPECT_EQ(path->cost, 0.0);
}

TYPED_TEST(GridPlanners, DoNotCutCorners) {
  const TraversalGrid grid = make_grid(draw({"..",  //
                                             "#."}));
  const auto path = TypeParam().plan(grid, {0, 1}, {1, 0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 2.0, 1e-9);
  EXPECT_EQ(path->cells, (std::vector<Cell>{{0, 1}, {1, 1}, {1, 0}}));
}

TYPED_TEST(GridPlanners, DoNotSlipBetweenTwoBlockedCellsThatTouch) {
  const TraversalGrid grid = make_grid(draw({"#.",  //
                                             ".#"}));
  EXPECT_EQ(TypeParam().plan(grid, {0, 0}, {1, 1}).error(), SearchFailure::kNoPath);
}

TYPED_TEST(GridPlanners, NoticeThatAGridHasChanged) {
  TypeParam planner;
  TraversalGrid grid = make_grid(draw({"..ii.."}), {.restricted_weight = 0.0});
  EXPECT_FALSE(planner.plan(grid, {0, 0}, {5, 0}));
  grid.open_around({2, 0}, 1.5);
  EXPECT_TRUE(planner.plan(grid, {0, 0}, {5, 0}));
  grid.close();
  EXPECT_FALSE(planner.plan(grid, {0, 0}, {5, 0}));
  grid.update(draw({"......"}));
  EXPECT_TRUE(planner.plan(grid, {0, 0}, {5, 0}));
  EXPECT_TRUE(planner.plan(make_grid(draw({"..", ".."})), {0, 0}, {1, 1})) << "a smaller one";
}

TYPED_TEST(OctilePlanners, GoRoundAWallByTheShortestWay) {
  // Over the top: up past the wall's end with two diagonals, and down again.
  const TraversalGrid grid = test::grid_with_a_wall();
  const auto path = TypeParam().plan(grid, {1, 0}, {5, 0});
  ASSERT_TRUE(path);
  // (1,0) (2,1) (2,2) (2,3) (3,3) (4,3) (4,2) (4,1) (5,0)
  EXPECT_NEAR(path->cost, 6.0 + 2.0 * std::numbers::sqrt2, 1e-6);
  EXPECT_EQ(path->cells.size(), 9U);
  expect_valid_steps(grid, *path);
}

TYPED_TEST(OctilePlanners, EqualDijkstraOnRandomUniformGrids) {
  RandomStream random(3, "grid_planners_test");
  TypeParam planner;
  Dijkstra dijkstra;
  int found = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const int width = 1 + static_cast<int>(random.below(trial % 10 == 0 ? 200 : 40));
    const int height = 1 + static_cast<int>(random.below(trial % 15 == 0 ? 200 : 40));
    const double blocked = 0.05 + 0.4 * random.uniform();
    const Grid<Cost> costs = test::random_costs(random, width, height, blocked, false);
    const TraversalGrid grid = make_grid(costs);
    const Cell start = costs.geometry.cell_at(random.below(costs.cells.size()));
    const Cell goal = costs.geometry.cell_at(random.below(costs.cells.size()));
    const auto expected = dijkstra.plan(grid, start, goal);
    const auto path = planner.plan(grid, start, goal);
    ASSERT_EQ(path.has_value(), expected.has_value()) << "trial " << trial;
    if (!path) {
      EXPECT_EQ(path.error(), expected.error());
      continue;
    }
    EXPECT_NEAR(path->cost, expected->cost, 1e-6) << "trial " << trial;
    EXPECT_EQ(path->cells.front(), start);
    EXPECT_EQ(path->cells.back(), goal);
    expect_valid_steps(grid, *path);
    ++found;
  }
  EXPECT_GT(found, 100);
}

TEST(AStar, EqualsDijkstraOnRandomWeightedGrids) {
  RandomStream random(5, "grid_planners_test");
  AStar planner;
  Dijkstra dijkstra;
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int width = 1 + static_cast<int>(random.below(80));
    const int height = 1 + static_cast<int>(random.below(80));
    Grid<Cost> costs =
        test::random_costs(random, width, height, trial % 3 == 2 ? 0.02 : 0.15, true);
    if (trial % 3 != 0) {  // patches of equal cost, so that pruning, runs and weights meet
      const int side = trial % 3 == 1 ? 8 : 25;
      for (std::size_t i = 0; i < costs.cells.size(); ++i) {
        const Cell cell = costs.geometry.cell_at(i);
        const Cost patch = costs[{cell.x / side * side, cell.y / side * side}];
        if (costs.cells[i] <= kMaxRestrictedCost && patch <= kMaxRestrictedCost) {
          costs.cells[i] = patch;
        }
      }
    }
    const TraversalGrid grid = make_grid(costs);
    const Cell start = costs.geometry.cell_at(random.below(costs.cells.size()));
    const Cell goal = costs.geometry.cell_at(random.below(costs.cells.size()));
    const auto expected = dijkstra.plan(grid, start, goal);
    const auto path = planner.plan(grid, start, goal);
    ASSERT_EQ(path.has_value(), expected.has_value()) << "trial " << trial;
    if (!path) continue;
    EXPECT_NEAR(path->cost, expected->cost, 1e-4 * (1.0 + expected->cost)) << "trial " << trial;
    expect_valid_steps(grid, *path);
    ++found;
  }
  EXPECT_GT(found, 100);
}

TEST(AStar, ExpandsLittleMoreThanTheLineInTheOpen) {
  const TraversalGrid grid = make_grid(Grid<Cost>({200, 200, 1.0, {0.0, 0.0}}, kFreeCost));
  AStar a_star;
  ASSERT_TRUE(a_star.plan(grid, {10, 100}, {190, 100}));
  EXPECT_LT(a_star.expansions(), 1000U);
}

TEST(JumpPoint, RefusesGridsWhoseCostsDiffer) {
  const Grid<Cost> costs = draw({".5."});
  EXPECT_EQ(JumpPoint().plan(make_grid(costs), {0, 0}, {2, 0}).error(),
            SearchFailure::kCostsDiffer);
  EXPECT_TRUE(JumpPoint().plan(make_grid(costs, {.restricted_weight = 0.0}), {0, 0}, {2, 0}));
}

TEST(JumpPoint, CrossesWordsOf64Cells) {
  // A corridor longer than two words; its only opening is beside the last cell of a word.
  Grid<Cost> costs({200, 3, 1.0, {0.0, 0.0}}, kLethalCost);
  for (int x = 0; x < 200; ++x) costs[{x, 0}] = kFreeCost;
  for (const int opening : {61, 62, 63, 64, 126, 127, 128}) {
    Grid<Cost> open = costs;
    open[{opening, 1}] = kFreeCost;
    open[{opening, 2}] = kFreeCost;
    for (const int start : {0, 199, opening}) {
      const auto path = JumpPoint().plan(make_grid(open), {start, 0}, {opening, 2});
      ASSERT_TRUE(path) << opening;
      EXPECT_EQ(path->cost, std::abs(start - opening) + 2.0);
      const auto back = JumpPoint().plan(make_grid(open), {opening, 2}, {start, 0});
      ASSERT_TRUE(back) << opening;
      EXPECT_EQ(back->cost, path->cost);
    }
  }
}

TEST(CellWithin, IsNothingOutsideAndForWhatIsNotFinite) {
  const GridGeometry grid{4, 2, 0.5, {-1.0, 0.0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cell_within(grid, {-1.0, 0.0}), (Cell{0, 0}));
  EXPECT_EQ(cell_within(grid, {0.99, 0.6}), (Cell{3, 1}));
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(nan, 0.1), Eigen::Vector2d(0.0, nan), Eigen::Vector2d(infinity, 0.1),
        Eigen::Vector2d(0.0, -infinity), Eigen::Vector2d(1.0, 0.1), Eigen::Vector2d(-1.1, 0.1),
        Eigen::Vector2d(1e300, 0.1)}) {
    EXPECT_FALSE(cell_within(grid, point)) << point.transpose();
  }
  EXPECT_FALSE(cell_within({}, {0.0, 0.0})) << "no cells, no resolution";
}

}  // namespace
}  // namespace coop
