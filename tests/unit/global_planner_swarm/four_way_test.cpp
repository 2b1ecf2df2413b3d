#include "global_planner/swarm/four_way.hpp"

#include <gmock/gmock.h>

#include "unit/global_planner_swarm/drawn_pen.hpp"

namespace coop::global_planner::swarm {
namespace {

using testing::ElementsAre;

TEST(LoopEraser, CutsALoopWhereTheTrackCrossesItself) {
  Track track{1, 2, 3, 4, 2, 5};
  LoopEraser().erase(track, 10);
  EXPECT_THAT(track, ElementsAre(1, 2, 5));
}

TEST(LoopEraser, DropsStepsThatStay) {
  Track track{7, 7, 8, 8, 8, 9};
  LoopEraser().erase(track, 10);
  EXPECT_THAT(track, ElementsAre(7, 8, 9));
}

TEST(LoopEraser, ForgetsTheTrackBefore) {
  LoopEraser eraser;
  Track first{1, 2, 3};
  eraser.erase(first, 10);
  Track second{3, 2, 1};
  eraser.erase(second, 10);
  EXPECT_THAT(second, ElementsAre(3, 2, 1));
}

TEST(LoopEraser, CellsOfALoopThatWasCutMayComeAgain) {
  Track track{1, 2, 3, 1, 3, 4};
  LoopEraser().erase(track, 10);
  EXPECT_THAT(track, ElementsAre(1, 3, 4));
}

TEST(FourWay, CostsAStepTheMeanOfItsTwoCells) {
  const TraversalGrid grid = test::draw_pen({".9."}, {.restricted_weight = 6.0});
  const Track track{grid.padded_index({0, 0}), grid.padded_index({1, 0}),
                    grid.padded_index({2, 0})};
  EXPECT_NEAR(path_of(grid, track).cost, 8.0, 1e-6);
}

TEST(FourWay, CountsTurns) {
  const TraversalGrid grid = test::draw_pen({"...", "..."});
  const auto at = [&](int x, int y) { return grid.padded_index({x, y}); };
  EXPECT_EQ(turns_of(Track{at(0, 0), at(1, 0), at(2, 0)}), 0);
  EXPECT_EQ(turns_of(Track{at(0, 0), at(1, 0), at(1, 1), at(2, 1)}), 2);
}

}  // namespace
}  // namespace coop::global_planner::swarm
