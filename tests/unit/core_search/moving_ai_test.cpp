#include "support/moving_ai.hpp"

#include <gtest/gtest.h>

#include "core/search/a_star.hpp"
#include "core/search/dijkstra.hpp"
#include "core/search/jump_point.hpp"
#include "core/search/theta_star.hpp"
#include "support/shared_data.hpp"

namespace coop {
namespace {

class MovingAi : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto map = test::shared_data(std::string("planning/") + GetParam() + ".map");
    const auto file = test::shared_data(std::string("planning/") + GetParam() + ".map.scen");
    if (!map || !file) GTEST_SKIP() << "not run: shared planning data is absent";
    grid_.update(test::read_moving_ai_map(*map));
    scenarios_ = test::read_scenarios(*file);
  }
  TraversalGrid grid_;
  std::vector<test::Scenario> scenarios_;
};

// A spread over all lengths keeps the test short; the planning experiment runs all of them.
TEST_P(MovingAi, PathsHaveThePublishedOptimalLengths) {
  ASSERT_GE(scenarios_.size(), 100U);
  Dijkstra dijkstra;
  AStar a_star;
  JumpPoint jump_point;
  for (std::size_t i = 0; i < scenarios_.size(); i += scenarios_.size() / 8) {
    const test::Scenario& scenario = scenarios_[i];
    for (GridPlanner* planner :
         {static_cast<GridPlanner*>(&dijkstra), static_cast<GridPlanner*>(&a_star),
          static_cast<GridPlanner*>(&jump_point)}) {
      const auto path = planner->plan(grid_, scenario.start, scenario.goal);
      ASSERT_TRUE(path) << "scenario " << i;
      EXPECT_NEAR(path->cost, scenario.length, scenario.tolerance) << "scenario " << i;
    }
  }
}

TEST_P(MovingAi, AnyAnglePathsLieBetweenTheStraightLineAndTheOctilePath) {
  ThetaStar theta_star;
  for (std::size_t i = 0; i < scenarios_.size(); i += scenarios_.size() / 2) {
    const test::Scenario& scenario = scenarios_[i];
    const auto path = theta_star.plan(grid_, scenario.start, scenario.goal);
    ASSERT_TRUE(path) << "scenario " << i;
    EXPECT_LE(path->cost, scenario.length + scenario.tolerance) << "scenario " << i;
    EXPECT_GE(path->cost, 0.92 * scenario.length) << "octile paths are at most 8.2 % longer";
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, MovingAi,
                         testing::Values("arena", "den312d", "brc202d", "orz900d", "AR0011SR",
                                         "32room_000", "random512-25-0", "maze512-4-0",
                                         "Berlin_0_512", "Boston_0_512"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace coop
