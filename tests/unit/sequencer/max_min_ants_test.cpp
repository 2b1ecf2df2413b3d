#include "sequencer/max_min_ants.hpp"

#include <gtest/gtest.h>

#include "sequencer/held_karp.hpp"
#include "support/shared_data.hpp"
#include "support/tsplib.hpp"
#include "unit/sequencer/cost_matrices.hpp"

namespace coop::sequencer {
namespace {

/// Few ants, for short tests.
MaxMinConfig few() {
  MaxMinConfig config;
  config.ants = 5;
  config.iterations = 20;
  return config;
}

struct Form {
  bool is_symmetric;
  bool closed;
};

class MaxMinAntsTest : public ::testing::TestWithParam<Form> {};

TEST_P(MaxMinAntsTest, NineEggsComeOutOptimal) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const CostMatrix costs =
        GetParam().is_symmetric ? test::random_places(10, seed) : test::asymmetric_places(10, seed);
    RandomStream random(seed, "ants");
    const Tour tour = solve_by_max_min_ants(costs, GetParam().closed, few(), random);
    ASSERT_TRUE(test::visits_all_once(tour.order, costs.size));
    EXPECT_NEAR(tour.cost, solve_exactly(costs, GetParam().closed).cost, 1e-9) << "seed " << seed;
    EXPECT_NEAR(tour.cost, tour_cost(costs, tour.order, GetParam().closed), 1e-12);
  }
}

TEST_P(MaxMinAntsTest, AnyNumberOfEggsIsVisitedOnceEach) {
  for (const std::size_t nodes : {2U, 3U, 4U, 5U, 6U, 60U}) {
    const CostMatrix costs =
        GetParam().is_symmetric ? test::random_places(nodes, 1) : test::asymmetric_places(nodes, 1);
    RandomStream random(1, "ants");
    const Tour tour = solve_by_max_min_ants(costs, GetParam().closed, few(), random);
    EXPECT_TRUE(test::visits_all_once(tour.order, nodes)) << nodes;
  }
}

TEST_P(MaxMinAntsTest, TheSameStreamGivesTheSameTour) {
  const CostMatrix costs =
      GetParam().is_symmetric ? test::random_places(30, 7) : test::asymmetric_places(30, 7);
  RandomStream a(5, "ants");
  RandomStream b(5, "ants");
  const Tour one = solve_by_max_min_ants(costs, GetParam().closed, few(), a);
  const Tour two = solve_by_max_min_ants(costs, GetParam().closed, few(), b);
  EXPECT_EQ(one.order, two.order);
  EXPECT_EQ(one.cost, two.cost);
}

INSTANTIATE_TEST_SUITE_P(Forms, MaxMinAntsTest,
                         ::testing::Values(Form{true, true}, Form{true, false}, Form{false, true},
                                           Form{false, false}),
                         [](const auto& test_case) {
                           return std::string(test_case.param.is_symmetric ? "Symmetric"
                                                                           : "Asymmetric") +
                                  (test_case.param.closed ? "Closed" : "Open");
                         });

TEST(MaxMinAntsTest, AnOpenTourIsAsLongInEitherForm) {
  const CostMatrix costs = test::random_places(40, 2);
  CostMatrix free_return = costs;  // asymmetric: entry and exit a place
  for (std::size_t i = 1; i < costs.size; ++i) free_return.at(i, 0) = 0.0;
  RandomStream a(1, "ants");
  RandomStream b(2, "ants");
  EXPECT_NEAR(solve_by_max_min_ants(costs, false, {}, a).cost,
              solve_by_max_min_ants(free_return, true, {}, b).cost, 1e-9);
}

TEST(MaxMinAntsTest, NoEggsNeedNoTour) {
  RandomStream random(1, "ants");
  EXPECT_TRUE(solve_by_max_min_ants(CostMatrix(1), false, few(), random).order.empty());
}

TEST(MaxMinAntsTest, EggsAllInOnePlaceCostNothing) {
  RandomStream random(1, "ants");
  const Tour tour = solve_by_max_min_ants(CostMatrix(40), false, few(), random);
  EXPECT_TRUE(test::visits_all_once(tour.order, 40));
  EXPECT_EQ(tour.cost, 0.0);
}

TEST(MaxMinAntsTest, HeapsOfEggsAreEmptiedOneAfterTheOther) {
  // Five heaps of 20 on a line, more than a place has neighbours; some exactly on top of others.
  RandomStream places(1, "heaps");
  std::vector<Eigen::Vector2d> eggs{{-1, 0}};
  for (int i = 0; i < 100; ++i) {
    const double spread = i % 2 == 0 ? 0.0 : 0.05;
    eggs.emplace_back(3.0 * (i % 5) + places.uniform(0, spread), places.uniform(0, spread));
  }
  RandomStream random(1, "ants");
  const Tour tour = solve_by_max_min_ants(test::distances(eggs), false, {}, random);
  int changes = 0;
  for (std::size_t i = 1; i < tour.order.size(); ++i) {
    if ((tour.order[i] - 1) % 5 != (tour.order[i - 1] - 1) % 5) ++changes;
  }
  EXPECT_EQ(changes, 4);
  EXPECT_LT(tour.cost, 13.0 + 5 * 0.05 * 10);
}

struct Instance {
  const char* name;
  double optimum;
};

/// The short form of the experiment in tests/experiments/sequencing.
class TspLibraryTest : public ::testing::TestWithParam<Instance> {};

TEST_P(TspLibraryTest, TheOptimumIsFound) {
  const auto path = coop::test::shared_data(std::string("tsp/") + GetParam().name + ".tsp");
  if (!path) GTEST_SKIP() << "not run: no " << GetParam().name << ".tsp";
  const CostMatrix costs = coop::test::load_tsplib(*path);
  RandomStream random(1, "ants");
  const Tour tour = solve_by_max_min_ants(costs, true, {}, random);
  EXPECT_EQ(tour.cost, GetParam().optimum);
  EXPECT_TRUE(test::visits_all_once(tour.order, costs.size));
}

INSTANTIATE_TEST_SUITE_P(Instances, TspLibraryTest,
                         ::testing::Values(Instance{"eil51", 426}, Instance{"berlin52", 7542},
                                           Instance{"st70", 675}, Instance{"kroA100", 21282}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(MaxMinAntsTest, TwoHundredAndEightyPlacesComeWithinAFifthOfAPercent) {
  const CostMatrix costs =
      coop::test::load_tsplib(std::filesystem::path(COOP_SOURCE_DIR) / "tests/data/tsp/a280.tsp");
  MaxMinConfig config;
  config.iterations = 50;
  RandomStream random(1, "ants");
  EXPECT_LE(solve_by_max_min_ants(costs, true, config, random).cost, 2579 * 1.002);
}

}  // namespace
}  // namespace coop::sequencer
