#include "sequencer/ant_colony.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sequencer/held_karp.hpp"

namespace coop::sequencer {
namespace {

using ::testing::ElementsAre;

CostMatrix distances(const std::vector<Eigen::Vector2d>& places) {
  CostMatrix costs(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) costs.at(i, j) = (places[i] - places[j]).norm();
  }
  return costs;
}

CostMatrix random_places(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, "places");
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < count; ++i) {
    places.emplace_back(random.uniform(0, 14), random.uniform(0, 9));
  }
  return distances(places);
}

double cheapest_by_trying_all(const CostMatrix& costs, bool closed) {
  std::vector<std::size_t> order(costs.size - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  double best = std::numeric_limits<double>::infinity();
  do {
    best = std::min(best, tour_cost(costs, order, closed));
  } while (std::ranges::next_permutation(order).found);
  return best;
}

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
