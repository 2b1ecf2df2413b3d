#include "sequencer/ant_colony.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sequencer/held_karp.hpp"
#include "unit/sequencer/cost_matrices.hpp"

namespace coop::sequencer {
namespace {

using ::testing::ElementsAre;

using test::cheapest_by_trying_all;
using test::distances;
using test::random_places;

TEST(AntColonyTest, EggsAlongALineAreCollectedInPassing) {
  const CostMatrix costs = distances({{0, 0}, {3, 0}, {1, 0}, {2, 0}});
  RandomStream random(1, "colony");
  const Tour tour = solve_by_ant_colony(costs, {}, random);
  EXPECT_THAT(tour.order, ElementsAre(2, 3, 1));
  EXPECT_DOUBLE_EQ(tour.cost, 3.0);
}

TEST(AntColonyTest, AClosedTourComesBackAndBeginsAtTheRobot) {
  const CostMatrix costs = distances({{0, 0}, {1, 1}, {1, 0}, {0, 1}});
  AntColonyConfig config;
  config.closed = true;
  RandomStream random(1, "colony");
  const Tour tour = solve_by_ant_colony(costs, config, random);
  EXPECT_DOUBLE_EQ(tour.cost, 4.0);
  EXPECT_DOUBLE_EQ(tour_cost(costs, tour.order, true), tour.cost);
}

TEST(AntColonyTest, FiveEggsComeOutOptimalForEverySeed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const CostMatrix costs = random_places(6, seed);
    RandomStream random(seed, "colony");
    const Tour tour = solve_by_ant_colony(costs, {}, random);
    EXPECT_NEAR(tour.cost, cheapest_by_trying_all(costs, false), 1e-9) << "seed " << seed;
    EXPECT_NEAR(tour.cost, tour_cost(costs, tour.order, false), 1e-9);
  }
}

TEST(AntColonyTest, TheSameStreamGivesTheSameTour) {
  const CostMatrix costs = random_places(15, 3);
  RandomStream a(5, "colony");
  RandomStream b(5, "colony");
  EXPECT_EQ(solve_by_ant_colony(costs, {}, a).order, solve_by_ant_colony(costs, {}, b).order);
}

TEST(AntColonyTest, EveryEggIsVisitedOnceEvenWhereNoWayLeads) {
  CostMatrix costs = random_places(7, 1);
  for (std::size_t i = 0; i < costs.size; ++i) {
    costs.at(i, 3) = costs.at(3, i) = std::numeric_limits<double>::infinity();
  }
  RandomStream random(1, "colony");
  auto order = solve_by_ant_colony(costs, {}, random).order;
  std::ranges::sort(order);
  EXPECT_THAT(order, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(AntColonyTest, NoEggsNeedNoTour) {
  RandomStream random(1, "colony");
  EXPECT_TRUE(solve_by_ant_colony(CostMatrix(1), {}, random).order.empty());
}

TEST(HeldKarpTest, IsAsGoodAsTryingAllOrders) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const bool closed : {false, true}) {
      const CostMatrix costs = random_places(7, seed);
      const Tour tour = solve_exactly(costs, closed);
      EXPECT_NEAR(tour.cost, cheapest_by_trying_all(costs, closed), 1e-9);
      EXPECT_NEAR(tour.cost, tour_cost(costs, tour.order, closed), 1e-9);
    }
  }
}

TEST(HeldKarpTest, EveryEggIsVisitedOnceEvenWhereNoWayLeads) {
  CostMatrix costs(5, std::numeric_limits<double>::infinity());
  auto order = solve_exactly(costs, false).order;
  std::ranges::sort(order);
  EXPECT_THAT(order, ElementsAre(1, 2, 3, 4));
}

}  // namespace
}  // namespace coop::sequencer
