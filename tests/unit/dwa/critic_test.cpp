#include "dwa/critic.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coop::dwa {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Head, Is180DegreesLessTheAngleToTheTarget) {
  EXPECT_NEAR(head({0, 0, 0}, {1, 0}), 180.0, 1e-9);
  EXPECT_NEAR(head({0, 0, 0}, {0, 1}), 90.0, 1e-9);
  EXPECT_NEAR(head({0, 0, 0}, {0, -1}), 90.0, 1e-9);
  EXPECT_NEAR(head({0, 0, 0}, {-1, 1e-12}), 0.0, 1e-6);
  EXPECT_NEAR(head({1, 1, kPi / 4}, {2, 2}), 180.0, 1e-9);
}

TEST(Head, OfARobotThatDrivesBackwardsLooksOverItsTail) {
  EXPECT_NEAR(head({0, 0, 0}, {-1, 0}, -1), 180.0, 1e-9);
}

TEST(Dist, IsTheDistanceFromTheEndToTheNearestObstacleUpToALimit) {
  const GridGeometry grid{40, 1, 0.1, {0.0, 0.0}};
  std::vector<std::uint8_t> cells(grid.size(), 0);
  cells[0] = 1;
  DistanceField field;
  field.update(grid, cells, 3.0);
  EXPECT_NEAR(dist(field, {1.05, 0.05, 0.0}, 1.5), 1.0, 1e-9);
  EXPECT_NEAR(dist(field, {2.55, 0.05, 0.0}, 1.5), 1.5, 1e-9);
}

TEST(Score, NormalisesByTheSumOverAllCandidates) {
  // head: 180, 90, 90 (sum 360); dist: 1, 2, 1 (sum 4); velocity: 0.1, 0.2, 0.5 (sum 0.8)
  const std::vector<Evaluation> candidates{
      {180.0, 1.0, 0.1, 0.0}, {90.0, 2.0, 0.2, 0.0}, {90.0, 1.0, 0.5, 0.0}};
  std::vector<double> scores;
  score({}, candidates, 0.0, scores);
  ASSERT_EQ(scores.size(), 3U);
  EXPECT_NEAR(scores[0], 0.05 * 0.50 + 0.10 * 0.25 + 0.10 * 0.125, 1e-12);
  EXPECT_NEAR(scores[1], 0.05 * 0.25 + 0.10 * 0.50 + 0.10 * 0.250, 1e-12);
  EXPECT_NEAR(scores[2], 0.05 * 0.25 + 0.10 * 0.25 + 0.10 * 0.625, 1e-12);
}

TEST(Score, AddsUpToTheWeightsBecauseEveryTermAddsUpToOne) {
  const std::vector<Evaluation> candidates{
      {10, 0.3, 0.4, 0}, {70, 0.9, 0.2, 0}, {130, 0.1, 0.6, 0}};
  std::vector<double> scores;
  score({}, candidates, 0.0, scores);
  EXPECT_NEAR(scores[0] + scores[1] + scores[2], 0.05 + 0.10 + 0.10, 1e-12);
}

TEST(Score, ATermThatIsZeroForAllDoesNotCount) {
  const std::vector<Evaluation> candidates{{180, 0, 0, 0}, {180, 0, 0, 0}};
  std::vector<double> scores;
  score({}, candidates, 0.0, scores);
  EXPECT_NEAR(scores[0], 0.025, 1e-12);
  EXPECT_NEAR(scores[1], 0.025, 1e-12);
}

TEST(Score, ThePathErrorCountsInSharesOfTheCandidates) {
  CriticConfig config;
  config.path_scale = 0.05;
  // The second is 5 cm off: it loses path_weight / 2.
  const std::vector<Evaluation> candidates{{90, 1, 0.2, 0.0}, {90, 1, 0.2, 0.0025}};
  std::vector<double> scores;
  score(config, candidates, 4.0, scores);
  EXPECT_NEAR(scores[0] - scores[1], 2.0, 1e-12);
}

TEST(Score, OfNoCandidatesIsEmpty) {
  std::vector<double> scores{1.0};
  score({}, {}, 1.0, scores);
  EXPECT_TRUE(scores.empty());
}

}  // namespace
}  // namespace coop::dwa
