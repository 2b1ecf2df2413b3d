#include "global_planner/swarm/casma.hpp"

#include <gmock/gmock.h>

#include "core/search/dijkstra.hpp"
#include "global_planner/swarm/step_search.hpp"
#include "unit/global_planner_swarm/drawn_pen.hpp"

namespace coop::global_planner::swarm {
namespace {

using test::draw_pen;
using testing::ElementsAre;

Casma make(const std::string& method, std::uint64_t seed = 1) {
  CasmaConfig config;
  config.method = method;
  return {config, RandomStream(seed, "casma_test")};
}

TEST(CellWave, SettlesACellADistanceWithEachGeneration) {
  const TraversalGrid grid = draw_pen({"...",  //
                                       ".#.",  //
                                       "..."});
  CellWave wave;
  EXPECT_TRUE(wave.spread(grid, grid.padded_index({1, 0}), grid.padded_index({1, 2})));
  EXPECT_FLOAT_EQ(wave.cost(grid.padded_index({1, 2})), 4.0F);
  EXPECT_FLOAT_EQ(wave.cost(grid.padded_index({0, 1})), 2.0F);
  EXPECT_EQ(wave.generations(), 4);
}

TEST(CellWave, EndsWhereTheGoalIsShutIn) {
  const TraversalGrid grid = draw_pen({".#.", ".#."});
  EXPECT_FALSE(CellWave().spread(grid, grid.padded_index({0, 0}), grid.padded_index({2, 0})));
}

TEST(CasmaBest, FindsTheOnlyWayThroughAGap) {
  const TraversalGrid grid = draw_pen({"...",  //
                                       "##.",  //
                                       "..."});
  const auto path = make("best").plan(grid, {0, 0}, {0, 2});
  ASSERT_TRUE(path);
  EXPECT_THAT(path->cells, ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}, Cell{2, 1}, Cell{2, 2},
                                       Cell{1, 2}, Cell{0, 2}));
  EXPECT_DOUBLE_EQ(path->cost, 6.0);
}

TEST(CasmaBest, TakesOneTurnInTheOpen) {
  const TraversalGrid grid = draw_pen(std::vector<std::string_view>(12, "............"));
  const auto path = make("best").plan(grid, {1, 1}, {10, 9});
  ASSERT_TRUE(path);
  Track track;
  for (const Cell cell : path->cells) track.push_back(grid.padded_index(cell));
  EXPECT_EQ(path->cells.size(), 18U);
  EXPECT_EQ(turns_of(track), 1);
}

TEST(CasmaBest, GoesRoundARestrictedZoneWhereThatIsCheaper) {
  const TraversalGrid grid = draw_pen({".....",  //
                                       "..9..",  //
                                       "....."},
                                      {.restricted_weight = 6.0});
  const auto path = make("best").plan(grid, {0, 1}, {4, 1});
  ASSERT_TRUE(path);
  // Through it: 1 + 4 + 4 + 1 = 10; round it: six steps.
  EXPECT_NEAR(path->cost, 6.0, 1e-9);
}

TEST(CasmaBest, StandsAtItsGoalWithAPathOfOneCell) {
  const TraversalGrid grid = draw_pen({"..."});
  const auto path = make("best").plan(grid, {1, 0}, {1, 0});
  ASSERT_TRUE(path);
  EXPECT_THAT(path->cells, ElementsAre(Cell{1, 0}));
}

TEST(Casma, TellsApartWhyThereIsNoPath) {
  const TraversalGrid grid = draw_pen({"..#."});
  for (const char* method : {"best", "paper", "printed"}) {
    Casma casma = make(method);
    EXPECT_EQ(casma.plan(grid, {0, 0}, {3, 0}).error(), SearchFailure::kNoPath);
    EXPECT_EQ(casma.plan(grid, {2, 0}, {0, 0}).error(), SearchFailure::kStartBlocked);
    EXPECT_EQ(casma.plan(grid, {0, 0}, {2, 0}).error(), SearchFailure::kGoalBlocked);
    EXPECT_EQ(casma.plan(TraversalGrid(), {0, 0}, {0, 0}).error(), SearchFailure::kEmptyGrid);
    EXPECT_EQ(casma.plan(grid, {-1, 0}, {0, 0}).error(), SearchFailure::kStartOutside);
    EXPECT_EQ(casma.plan(grid, {0, 0}, {9, 9}).error(), SearchFailure::kGoalOutside);
  }
}

TEST(CasmaBest, IsAsShortAsExactSearchOnRandomGrids) {
  RandomStream random(5, "random pens");
  Casma casma = make("best");
  StepSearch dijkstra(StepSearch::Guidance::kNone);
  int reached = 0;
  for (int i = 0; i < 200; ++i) {
    const TraversalGrid grid =
        test::random_pen(1 + static_cast<int>(random.below(25)),
                         1 + static_cast<int>(random.below(25)), 0.3, random);
    const auto draw = [&] { return grid.geometry().cell_at(random.below(grid.geometry().size())); };
    const Cell start = draw();
    const Cell goal = draw();
    const auto path = casma.plan(grid, start, goal);
    const auto exact = dijkstra.plan(grid, start, goal);
    ASSERT_EQ(path.has_value(), exact.has_value());
    if (!path) {
      EXPECT_EQ(path.error(), exact.error());
      continue;
    }
    ++reached;
    EXPECT_EQ(path->cells.size(), exact->cells.size());
    EXPECT_TRUE(test::is_walkable(grid, path->cells));
    EXPECT_EQ(path->cells.front(), start);
    EXPECT_EQ(path->cells.back(), goal);
  }
  EXPECT_GT(reached, 50);
}

TEST(CasmaPaper, FindsAWalkableWayInASmallPen) {
  const TraversalGrid grid = draw_pen({"........",  //
                                       "...##...",  //
                                       "...##...",  //
                                       "........"});
  // Towards the origin, where equation 7 pulls.
  const auto path = make("paper").plan(grid, {7, 3}, {1, 0});
  ASSERT_TRUE(path);
  EXPECT_TRUE(test::is_walkable(grid, path->cells));
  EXPECT_GE(path->cells.size(), 10U);
}

TEST(CasmaPaper, GivesTheSamePathForTheSameSeed) {
  const TraversalGrid grid = draw_pen(std::vector<std::string_view>(9, "........."));
  EXPECT_EQ(make("paper", 3).plan(grid, {1, 1}, {7, 6})->cells,
            make("paper", 3).plan(grid, {1, 1}, {7, 6})->cells);
}

TEST(CasmaPrinted, DrawsAllMouldsToTheLowerLeftCorner) {
  const TraversalGrid grid = draw_pen(std::vector<std::string_view>(20, "...................."));
  EXPECT_EQ(make("printed").plan(grid, {8, 8}, {15, 15}).error(), SearchFailure::kNoPath);
  // The corner itself, and only what lies towards it, can be its goal.
  EXPECT_TRUE(make("printed").plan(grid, {8, 8}, {0, 0}));
}

}  // namespace
}  // namespace coop::global_planner::swarm
