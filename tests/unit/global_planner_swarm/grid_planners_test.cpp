// What holds for all of the family: A*, Dijkstra's algorithm, ants, taboo search, swarms over via
// points.
#include <gtest/gtest.h>

#include <memory>

#include "experiments/casma/contenders.hpp"
#include "global_planner/swarm/ant_colony.hpp"
#include "global_planner/swarm/step_search.hpp"
#include "global_planner/swarm/tabu.hpp"
#include "global_planner/swarm/via_points.hpp"
#include "unit/global_planner_swarm/drawn_pen.hpp"

namespace coop::global_planner::swarm {
namespace {

using test::draw_pen;

TEST(StepSearch, AStarIsAsShortAsDijkstraAndLooksAtFewerCells) {
  RandomStream random(9, "random pens");
  StepSearch astar(StepSearch::Guidance::kManhattan);
  StepSearch dijkstra(StepSearch::Guidance::kNone);
  std::size_t astar_expanded = 0;
  std::size_t dijkstra_expanded = 0;
  for (int i = 0; i < 200; ++i) {
    const TraversalGrid grid = test::random_pen(20, 15, 0.25, random);
    const Cell start = grid.geometry().cell_at(random.below(grid.geometry().size()));
    const Cell goal = grid.geometry().cell_at(random.below(grid.geometry().size()));
    const auto path = astar.plan(grid, start, goal);
    const auto exact = dijkstra.plan(grid, start, goal);
    ASSERT_EQ(path.has_value(), exact.has_value());
    if (!path) continue;
    EXPECT_EQ(path->cells.size(), exact->cells.size());
    EXPECT_TRUE(test::is_walkable(grid, path->cells));
    astar_expanded += astar.expanded();
    dijkstra_expanded += dijkstra.expanded();
  }
  EXPECT_LT(2 * astar_expanded, dijkstra_expanded);
}

TEST(StepSearch, NeverTakesADiagonal) {
  const TraversalGrid grid = draw_pen({"..", ".."});
  const auto path = StepSearch(StepSearch::Guidance::kManhattan).plan(grid, {0, 0}, {1, 1});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->cells.size(), 3U);
}

TEST(ViaPointObjective, CountsStepsAndBlockedCells) {
  const TraversalGrid grid = draw_pen({".....",  //
                                       "..#..",  //
                                       "....."});
  ViaPointObjective objective({.via_points = 1});
  objective.set(grid, {0, 1}, {4, 1});
  // Over (2, 2): up and right, or right and up through the pig, which is dearer; then down.
  EXPECT_DOUBLE_EQ(objective(std::vector<double>{2.5, 2.5}), 6.0);
  // Straight through the blocked cell, which belongs to both legs: 4 steps and twice 5 + 3.
  EXPECT_DOUBLE_EQ(objective(std::vector<double>{2.5, 1.5}), 4.0 + 2.0 * 8.0);
  Track track;
  EXPECT_TRUE(objective.trace(std::vector<double>{2.5, 2.5}, track));
  EXPECT_EQ(track.size(), 7U);
  EXPECT_FALSE(objective.trace(std::vector<double>{2.5, 1.5}, track));
}

TEST(Tabu, LeavesADeadEnd) {
  const TraversalGrid grid = draw_pen({".......",  //
                                       ".####..",  //
                                       "....#.G",  //
                                       ".####..",  //
                                       "......."});
  const auto path = Tabu({}, RandomStream(1, "tabu")).plan(grid, {1, 2}, {6, 2});
  ASSERT_TRUE(path);
  EXPECT_TRUE(test::is_walkable(grid, path->cells));
}

TEST(AntColony, FindsTheShorterOfTwoWays) {
  const TraversalGrid grid = draw_pen({"........",  //
                                       ".######.",  //
                                       ".######.",  //
                                       "........",  //
                                       ".######.",  //
                                       "........"});
  const auto path =
      AntColony({.ants = 20, .iterations = 50}, RandomStream(1, "aco")).plan(grid, {0, 2}, {7, 2});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->cells.size(), 8U);
}

class Contenders : public testing::TestWithParam<std::size_t> {
 protected:
  [[nodiscard]] std::unique_ptr<GridPlanner> make() const {
    return casma::contenders().at(GetParam()).make(1);
  }
};

TEST_P(Contenders, RefuseBlockedEndsAndFindNothingThroughAWall) {
  const TraversalGrid grid = draw_pen({"..#.", "..#."});
  EXPECT_EQ(make()->plan(grid, {0, 0}, {2, 0}).error(), SearchFailure::kGoalBlocked);
  EXPECT_EQ(make()->plan(grid, {2, 1}, {0, 0}).error(), SearchFailure::kStartBlocked);
  EXPECT_EQ(make()->plan(grid, {0, 0}, {-1, 0}).error(), SearchFailure::kGoalOutside);
  EXPECT_EQ(make()->plan(grid, {0, 0}, {3, 1}).error(), SearchFailure::kNoPath);
}

TEST_P(Contenders, WhateverTheyFindIsWalkable) {
  const TraversalGrid grid = draw_pen({"..........",  //
                                       "...###....",  //
                                       "...###....",  //
                                       "...###....",  //
                                       ".........."});
  const auto path = make()->plan(grid, {1, 1}, {8, 4});
  if (!path) return;  // CASMA to the letter finds none
  EXPECT_TRUE(test::is_walkable(grid, path->cells));
  EXPECT_EQ(path->cells.front(), (Cell{1, 1}));
  EXPECT_EQ(path->cells.back(), (Cell{8, 4}));
  EXPECT_DOUBLE_EQ(path->cost, static_cast<double>(path->cells.size() - 1));
}

INSTANTIATE_TEST_SUITE_P(All, Contenders,
                         testing::Range(std::size_t{0}, casma::contenders().size()));

}  // namespace
}  // namespace coop::global_planner::swarm
