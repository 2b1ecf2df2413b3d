#include "sequencer/ordering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sequencer/held_karp.hpp"
#include "unit/sequencer/cost_matrices.hpp"

namespace coop::sequencer {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNoWay = std::numeric_limits<double>::infinity();

OrderingStreams streams(std::uint64_t seed = 1) {
  return {RandomStream(seed, "paper"), RandomStream(seed, "best")};
}

class OrderingTest : public ::testing::TestWithParam<OrderingMethod> {
 protected:
  Ordering order(const CostMatrix& costs) {
    return order_nodes(costs, GetParam(), colony_, {}, streams_);
  }
  static void block(CostMatrix& costs, std::size_t node, double cost) {
    for (std::size_t i = 0; i < costs.size; ++i) {
      if (i != node) costs.at(i, node) = costs.at(node, i) = cost;
    }
  }
  AntColonyConfig colony_;
  OrderingStreams streams_ = streams();
};

TEST_P(OrderingTest, NothingToCollectIsNoOrder) {
  EXPECT_THAT(order(CostMatrix(0)).tour.order, IsEmpty());
  EXPECT_THAT(order(CostMatrix(1)).tour.order, IsEmpty());
}

TEST_P(OrderingTest, OneEggIsTheOrder) {
  const Ordering ordering = order(CostMatrix(2, 3.0));
  EXPECT_THAT(ordering.tour.order, ElementsAre(1));
  EXPECT_EQ(ordering.tour.cost, 3.0);
  EXPECT_EQ(ordering.alternative_cost, 3.0);
}

TEST_P(OrderingTest, UnreachableEggsAreSetAsideAndDoNotSpoilTheOrderOfTheOthers) {
  CostMatrix costs = test::distances({{0, 0}, {3, 0}, {9, 9}, {1, 0}, {8, 8}, {2, 0}});
  block(costs, 2, kNoWay);
  block(costs, 4, std::nan(""));
  const Ordering ordering = order(costs);
  EXPECT_THAT(ordering.tour.order, ElementsAre(3, 5, 1));
  EXPECT_THAT(ordering.unreachable, ElementsAre(2, 4));
  EXPECT_DOUBLE_EQ(ordering.tour.cost, 3.0);
  EXPECT_DOUBLE_EQ(ordering.alternative_cost, 3.0);
}

TEST_P(OrderingTest, WhereNoEggCanBeReachedAllAreSetAside) {
  for (const double cost : {kNoWay, std::nan(""), -1.0}) {
    const Ordering ordering = order(CostMatrix(4, cost));
    EXPECT_THAT(ordering.tour.order, IsEmpty());
    EXPECT_THAT(ordering.unreachable, ElementsAre(1, 2, 3));
    EXPECT_EQ(ordering.tour.cost, 0.0);
  }
}

TEST_P(OrderingTest, AGapBetweenTwoEggsIsGoneAround) {
  CostMatrix costs = test::distances({{0, 0}, {1, 0}, {1.1, 0}, {1, 5}});
  costs.at(1, 2) = costs.at(2, 1) = std::nan("");
  const Ordering ordering = order(costs);
  EXPECT_THAT(ordering.tour.order, ElementsAre(1, 3, 2));
  EXPECT_TRUE(std::isfinite(ordering.tour.cost));
}

TEST_P(OrderingTest, EggsThatCannotAllBeJoinedAreStillOrdered) {
  CostMatrix costs(20, kNoWay);  // there is a way from the robot to each, from none to another
  for (std::size_t i = 1; i < 20; ++i) costs.at(0, i) = 1.0;
  const Ordering ordering = order(costs);
  EXPECT_TRUE(test::visits_all_once(ordering.tour.order, 20));
  EXPECT_EQ(ordering.tour.cost, kNoWay);
}

TEST_P(OrderingTest, EggsOnTopOfOneAnotherAreEachVisited) {
  for (const std::size_t nodes : {5U, 30U}) {
    const Ordering ordering = order(CostMatrix(nodes, 0.0));
    EXPECT_TRUE(test::visits_all_once(ordering.tour.order, nodes));
    EXPECT_EQ(ordering.tour.cost, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, OrderingTest,
                         ::testing::Values(OrderingMethod::kPaper, OrderingMethod::kBest),
                         [](const auto& test_case) {
                           return test_case.param == OrderingMethod::kPaper ? "Paper" : "Best";
                         });

TEST(OrderingMethodTest, BestIsExactUpToTwelveEggs) {
  const CostMatrix costs = test::random_places(kMaxExactTargets + 1, 4);
  OrderingStreams some = streams();
  const Ordering ordering = order_nodes(costs, OrderingMethod::kBest, {}, {}, some);
  EXPECT_DOUBLE_EQ(ordering.tour.cost, solve_exactly(costs, false).cost);
  EXPECT_GE(ordering.alternative_cost, ordering.tour.cost - 1e-9);
}

TEST(OrderingMethodTest, BestIsNoWorseThanThePaperBeyond) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    OrderingStreams some = streams(seed);
    const Ordering ordering =
        order_nodes(test::random_places(40, seed), OrderingMethod::kBest, {}, {}, some);
    EXPECT_LE(ordering.tour.cost, ordering.alternative_cost + 1e-9);
  }
}

TEST(OrderingMethodTest, TheOtherMethodIsNotAskedForTooMany) {
  OrderingStreams some = streams();
  const Ordering ordering =
      order_nodes(test::random_places(kMaxCompared + 1, 1), OrderingMethod::kBest, {}, {}, some);
  EXPECT_EQ(ordering.alternative_cost, 0.0);
}

}  // namespace
}  // namespace coop::sequencer
