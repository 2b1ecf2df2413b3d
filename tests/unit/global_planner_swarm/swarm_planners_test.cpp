#include "global_planner/swarm/swarm_planners.hpp"

#include <gtest/gtest.h>

#include "core/config/config.hpp"
#include "unit/global_planner_swarm/drawn_pen.hpp"

namespace coop::global_planner::swarm {
namespace {

TEST(SwarmPlanners, EveryNameMakesAPlannerThatFindsItsWay) {
  const TraversalGrid grid = test::draw_pen({".....", "..#..", "....."});
  for (const std::string_view name : kSwarmPlanners) {
    const auto planner = make_swarm_planner(name, {}, RandomStream(1, name));
    ASSERT_NE(planner, nullptr) << name;
    const auto path = planner->plan(grid, {4, 1}, {0, 1});
    ASSERT_TRUE(path) << name;
    EXPECT_EQ(path->cells.size(), 7U) << name;
  }
  EXPECT_EQ(make_swarm_planner("bees", {}, RandomStream(1, "bees")), nullptr);
}

TEST(SwarmPlanners, ReadTheirConfigurationFromYaml) {
  const auto config =
      config::Document::parse("casma: {method: paper, iterations: 20}\nfa: {gamma: 2}", "test")
          .read<SwarmConfig>();
  EXPECT_EQ(config.casma.method, "paper");
  EXPECT_EQ(config.casma.iterations, 20);
  EXPECT_DOUBLE_EQ(config.fa.gamma, 2.0);
  EXPECT_THROW((void)config::Document::parse("casma: {method: bee}", "test").read<SwarmConfig>(),
               config::Error);
}

}  // namespace
}  // namespace coop::global_planner::swarm
