#include "global_planner/swarm/slime_mould.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coop::global_planner::swarm {
namespace {

TEST(SlimeWeight, LiesInTheIntervalsOfThePaper) {
  // Equation 2 with r = 1: the worst gets log10(2) = 0.301 more or less, the best nothing.
  EXPECT_NEAR(slime::weight(true, 1.0, 30.0, 10.0, 30.0), 1.30103, 1e-5);
  EXPECT_NEAR(slime::weight(false, 1.0, 30.0, 10.0, 30.0), 0.69897, 1e-5);
  EXPECT_DOUBLE_EQ(slime::weight(true, 1.0, 10.0, 10.0, 30.0), 1.0);
}

TEST(SlimeWeight, IsOneWhereAllAreAlike) {
  EXPECT_DOUBLE_EQ(slime::weight(true, 0.7, 5.0, 5.0, 5.0), 1.0);
}

TEST(SlimeRanges, FallToNothingWithTheIterations) {
  EXPECT_NEAR(slime::approach_range(250, 500), std::atanh(0.5), 1e-12);
  EXPECT_DOUBLE_EQ(slime::approach_range(500, 500), 0.0);
  EXPECT_DOUBLE_EQ(slime::contraction_range(125, 500), 0.75);
}

TEST(SlimeFading, FallsFromOneToZero) {
  EXPECT_NEAR(slime::fading(1, 500), 1.0, 1e-12);
  EXPECT_NEAR(slime::fading(250, 500), 1.0 - std::exp(-1.0), 1e-12);
  EXPECT_DOUBLE_EQ(slime::fading(500, 500), 0.0);
}

TEST(CellPheromone, PrintedWeightNeverReachesTheShareOfRandomMoves) {
  // 500 iterations of 100 moulds, all of them in one cell: equation 6 to the letter is negative
  // from the first visit on, so it always stays below z = 0.3.
  CellPheromone pheromone;
  pheromone.reset(4);
  for (int i = 0; i < 50000; ++i) {
    ASSERT_LT(pheromone.printed_weight(2, slime::fading(1 + i / 100, 500)), 0.3);
    pheromone.visit(2);
  }
  EXPECT_NEAR(pheromone.at(2), 3e-4 + 50000 * 1e-4, 1e-9);
}

TEST(CellPheromone, WeightIsZeroInTheStrongestCellAndLargeInAnEmptyOne) {
  CellPheromone pheromone;
  pheromone.reset(2);
  for (int i = 0; i < 27; ++i) pheromone.visit(0);
  EXPECT_NEAR(pheromone.weight(0, 1.0), 0.0, 1e-12);
  EXPECT_NEAR(pheromone.weight(1, 1.0), 0.9, 1e-12);
}

TEST(Ranking, FindsTheBetterHalfBestAndWorst) {
  Ranking ranking;
  ranking.update({4.0, 1.0, 3.0, 2.0});
  EXPECT_FALSE(ranking.in_better_half(0));
  EXPECT_TRUE(ranking.in_better_half(1));
  EXPECT_FALSE(ranking.in_better_half(2));
  EXPECT_TRUE(ranking.in_better_half(3));
  EXPECT_DOUBLE_EQ(ranking.best(), 1.0);
  EXPECT_DOUBLE_EQ(ranking.worst(), 4.0);
}

}  // namespace
}  // namespace coop::global_planner::swarm
