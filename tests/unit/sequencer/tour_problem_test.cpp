#include "sequencer/tour_problem.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/sequencer/cost_matrices.hpp"

namespace coop::sequencer {
namespace {

using ::testing::ElementsAre;
using Vertices = std::vector<TourProblem::Vertex>;

/// 0, 1, 2 and 3 m along a line.
CostMatrix line() {
  return test::distances({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
}

TEST(TourProblemTest, AClosedTourIsItsNodesTurnedToTheStart) {
  const TourProblem problem(line(), true, 3);
  EXPECT_EQ(problem.size(), 4U);
  EXPECT_THAT(problem.order(Vertices{2, 3, 0, 1}), ElementsAre(1, 2, 3));
  EXPECT_DOUBLE_EQ(problem.length(Vertices{2, 3, 0, 1}), 6.0);
}

TEST(TourProblemTest, AnOpenTourHasAFreeEndJoinedToTheStart) {
  const TourProblem problem(line(), false, 3);
  EXPECT_EQ(problem.size(), 5U);
  EXPECT_TRUE(problem.is_fixed(0, problem.end()));
  EXPECT_THAT(problem.order(Vertices{2, 3, 4, 0, 1}), ElementsAre(1, 2, 3));
  EXPECT_THAT(problem.order(Vertices{1, 0, 4, 3, 2}), ElementsAre(1, 2, 3)) << "read backwards";
  EXPECT_DOUBLE_EQ(problem.length(Vertices{1, 0, 4, 3, 2}), 3.0) << "the way back is free";
}

TEST(TourProblemTest, OfAnAsymmetricNodeThereAreEntryAndExit) {
  CostMatrix costs = line();
  costs.at(1, 0) = 10.0;
  const TourProblem problem(costs, true, 3);
  EXPECT_EQ(problem.size(), 8U);
  const Vertices forward{0, 4, 1, 5, 2, 6, 3, 7};
  const Vertices backward(forward.rbegin(), forward.rend());
  EXPECT_THAT(problem.order(forward), ElementsAre(1, 2, 3));
  EXPECT_THAT(problem.order(backward), ElementsAre(1, 2, 3));
  EXPECT_DOUBLE_EQ(problem.length(forward), 6.0);
  EXPECT_DOUBLE_EQ(problem.length(Vertices{0, 4, 3, 7, 2, 6, 1, 5}), 3.0 + 1.0 + 1.0 + 10.0);
}

TEST(TourProblemTest, NeighboursAreTheNearestButPartnerAndEnd) {
  const TourProblem problem(line(), false, 2);
  EXPECT_THAT(problem.neighbours(0), ElementsAre(1, 2));
  EXPECT_THAT(problem.neighbours(2), ElementsAre(1, 3));
  EXPECT_THAT(problem.neighbours(3), ElementsAre(2, 1));
}

TEST(TourProblemTest, RoundingDoesNotMakeCostsAsymmetric) {
  CostMatrix costs = line();
  costs.at(2, 1) += 1e-7;
  EXPECT_TRUE(is_symmetric(costs));
  costs.at(2, 1) += 1e-2;
  EXPECT_FALSE(is_symmetric(costs));
}

}  // namespace
}  // namespace coop::sequencer
