#include "core/search/dijkstra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <queue>

#include "core/random.hpp"
#include "support/traversal_drawing.hpp"

namespace coop {
namespace {

using test::draw;
using test::make_grid;

TEST(Dijkstra, TakesDiagonalsInTheOpen) {
  const TraversalGrid grid = make_grid(draw({"....",  //
                                             "....",  //
                                             "...."}));
  const auto path = Dijkstra().plan(grid, {0, 0}, {3, 2});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 1.0 + 2.0 * std::numbers::sqrt2, 1e-9);
  EXPECT_EQ(path->cells.front(), (Cell{0, 0}));
  EXPECT_EQ(path->cells.back(), (Cell{3, 2}));
  EXPECT_EQ(path->cells.size(), 4U);
}

TEST(Dijkstra, DoesNotCutCorners) {
  const TraversalGrid grid = make_grid(draw({"..",  //
                                             "#."}));
  const auto path = Dijkstra().plan(grid, {0, 1}, {1, 0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 2.0, 1e-9);
}

TEST(Dijkstra, WeighsAStepWithTheMeanOfItsTwoCells) {
  const TraversalGrid grid = make_grid(draw({".9."}), {.restricted_weight = 6.0});
  const auto path = Dijkstra().plan(grid, {0, 0}, {2, 0});
  ASSERT_TRUE(path);
  // Factors 1, 7, 1: two steps of (1 + 7) / 2.
  EXPECT_NEAR(path->cost, 8.0, 1e-9);
}

TEST(Dijkstra, GoesRoundARestrictedZoneWhereThatIsCheaper) {
  const TraversalGrid grid = make_grid(draw({".....",  //
                                             "..9..",  //
                                             "....."}),
                                       {.restricted_weight = 6.0});
  const auto path = Dijkstra().plan(grid, {0, 1}, {4, 1});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 2.0 + 2.0 * std::numbers::sqrt2, 1e-9);
  for (const Cell cell : path->cells) EXPECT_FALSE(cell == (Cell{2, 1}));
}

TEST(Dijkstra, TellsApartWhyThereIsNoPath) {
  const TraversalGrid grid = make_grid(draw({"..#.",  //
                                             "..#i"}));
  Dijkstra dijkstra;
  EXPECT_EQ(dijkstra.plan(grid, {0, 0}, {3, 1}).error(), SearchFailure::kNoPath);
  EXPECT_EQ(dijkstra.plan(grid, {2, 0}, {0, 1}).error(), SearchFailure::kStartBlocked);
  EXPECT_EQ(dijkstra.plan(grid, {0, 0}, {3, 0}).error(), SearchFailure::kGoalBlocked);
  EXPECT_EQ(dijkstra.plan(grid, {0, 0}, {4, 0}).error(), SearchFailure::kGoalOutside);
}

TEST(Dijkstra, CrossesUnknownCellsOnlyWhereThatIsAllowed) {
  const Grid<Cost> costs = draw({".?."});
  EXPECT_FALSE(Dijkstra().plan(make_grid(costs), {0, 0}, {2, 0}));
  const auto path = Dijkstra().plan(
      make_grid(costs, {.unknown_weight = 2.0, .allow_unknown = true}), {0, 0}, {2, 0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 4.0, 1e-9);
}

TEST(TraversalGrid, OpensInscribedCellsAroundAStartAndClosesThemAgain) {
  TraversalGrid grid = make_grid(draw({"ii...i"}));
  EXPECT_FALSE(Dijkstra().plan(grid, {0, 0}, {4, 0}));
  grid.open_around({0, 0}, 1.5);
  EXPECT_TRUE(Dijkstra().plan(grid, {0, 0}, {4, 0}));
  EXPECT_FALSE(Dijkstra().plan(grid, {0, 0}, {5, 0}));
  grid.close();
  EXPECT_FALSE(Dijkstra().plan(grid, {0, 0}, {4, 0}));
}

/// Plain Dijkstra with a heap in doubles, to compare with.
std::vector<double> reference_costs(const TraversalGrid& grid, Cell goal) {
  const GridGeometry& geometry = grid.geometry();
  std::vector<double> cost(geometry.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[geometry.index(goal)] = 0.0;
  open.emplace(0.0, geometry.index(goal));
  while (!open.empty()) {
    const auto [here_cost, index] = open.top();
    open.pop();
    if (here_cost > cost[index]) continue;
    const Cell here = geometry.cell_at(index);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{here.x + dx, here.y + dy};
        if ((dx == 0 && dy == 0) || !grid.passable(next)) continue;
        if (!grid.passable({here.x + dx, here.y}) || !grid.passable({here.x, here.y + dy}))
          continue;
        const double step =
            std::hypot(dx, dy) * 0.5 *
            (grid.factor(grid.padded_index(here)) + grid.factor(grid.padded_index(next)));
        const double candidate = here_cost + step;
        if (candidate >= cost[geometry.index(next)]) continue;
        cost[geometry.index(next)] = candidate;
        open.emplace(candidate, geometry.index(next));
      }
    }
  }
  return cost;
}

TEST(Dijkstra, EqualsAPlainHeapSearchOnRandomWeightedGrids) {
  RandomStream random(11, "dijkstra_test");
  Dijkstra dijkstra;
  for (int trial = 0; trial < 30; ++trial) {
    Grid<Cost> costs({1 + static_cast<int>(random.below(30)),
                      1 + static_cast<int>(random.below(30)),
                      1.0,
                      {0.0, 0.0}},
                     kFreeCost);
    for (Cost& cost : costs.cells) {
      const double u = random.uniform();
      cost = u < 0.2 ? kLethalCost : (u < 0.6 ? static_cast<Cost>(random.below(253)) : kFreeCost);
    }
    const Cell goal = costs.geometry.cell_at(random.below(costs.cells.size()));
    costs[goal] = kFreeCost;
    const TraversalGrid grid = make_grid(costs);
    dijkstra.flood(grid, goal, std::numeric_limits<double>::infinity());
    const std::vector<double> expected = reference_costs(grid, goal);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Cell cell = costs.geometry.cell_at(i);
      if (std::isinf(expected[i])) {
        EXPECT_TRUE(std::isinf(dijkstra.cost_to_goal(cell)));
      } else {
        EXPECT_NEAR(dijkstra.cost_to_goal(cell), expected[i], 1e-4 * (1.0 + expected[i]));
        EXPECT_NEAR(dijkstra.path_from(grid, cell).cost, expected[i], 1e-4 * (1.0 + expected[i]));
      }
    }
  }
}

}  // namespace
}  // namespace coop
