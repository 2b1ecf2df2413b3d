#include "amcl/likelihood_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace coop::amcl {
namespace {

/// Cells of 1 m, rows from the top: # occupied, . free, ? unknown.
OccupancyGrid draw(const std::vector<std::string>& rows, Eigen::Vector2d origin = {0, 0}) {
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  OccupancyGrid map({width, height, 1.0, origin}, kFree);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      map[{x, y}] = c == '#' ? kOccupied : c == '?' ? kUnknown : kFree;
    }
  }
  return map;
}

/// One beam hits within one metre (sigma), nine of ten beams hit, random ones end within 10 m.
constexpr LikelihoodFieldConfig kWide{
    .hit_stddev = 1.0, .hit_weight = 0.9, .random_weight = 0.1, .random_range = 10.0};
const double kPeak = 1.0 / std::sqrt(2.0 * std::numbers::pi);
const double kPerfect = 0.9 * kPeak + 0.01;

double expected(double distance) {
  return std::log((0.9 * kPeak * std::exp(-0.5 * distance * distance) + 0.01) / kPerfect);
}

TEST(LikelihoodField, FollowsTheDistanceToTheNearestObstacle) {
  const LikelihoodField field(kWide, draw({".....",  //
                                           "..#..",  //
                                           "....."}));
  EXPECT_NEAR(field.log_likelihood({2.5, 1.5}), 0.0, 1e-6) << "on the obstacle";
  EXPECT_NEAR(field.log_likelihood({1.5, 1.5}), expected(1.0), 1e-6);
  EXPECT_NEAR(field.log_likelihood({1.5, 0.5}), expected(std::sqrt(2.0)), 1e-6);
  EXPECT_NEAR(field.log_likelihood({0.5, 2.5}), expected(std::sqrt(5.0)), 1e-6);
}

TEST(LikelihoodField, UnknownSpaceAndOutsideAreAsLikelyAsARandomReading) {
  const LikelihoodField field(kWide, draw({"..........??"}));
  const double unknown = std::log(0.1 / kPerfect);
  EXPECT_NEAR(field.log_likelihood({10.5, 0.5}), unknown, 1e-6);
  EXPECT_NEAR(field.log_likelihood({-3, 0.5}), unknown, 1e-6);
  EXPECT_NEAR(field.log_likelihood({1e6, -1e6}), unknown, 1e-6);
  EXPECT_NEAR(field.log_likelihood({5.5, 0.5}), std::log(0.01 / kPerfect), 1e-6)
      << "free space without an obstacle anywhere: less likely than unknown";
}

TEST(LikelihoodField, ABeamThatEndsJustBehindAWallsFaceStillHits) {
  const LikelihoodField field(kWide, draw({"...#?????"}));
  EXPECT_NEAR(field.log_likelihood({4.5, 0.5}), expected(1.0), 1e-6);
  EXPECT_NEAR(field.log_likelihood({8.5, 0.5}), std::log(0.1 / kPerfect), 1e-6);
}

TEST(LikelihoodField, ScoresAParticleByTheMeanOverItsBeams) {
  LikelihoodField field(kWide, draw({".....", "..#..", "....."}, {-2.5, -1.5}));
  // The obstacle's middle is the map's origin. A particle 2 m to its right that looks at it sees it
  // 2 m ahead; the second beam ends 1 m short of it.
  ParticleSet particles;
  particles.push_back({2, 0, std::numbers::pi}, 1.0F);
  particles.push_back({2, 0, 0}, 1.0F);
  BeamEnds ends;
  ends.x = {2.0F, 1.0F};
  ends.y = {0.0F, 0.0F};
  std::vector<float> scores;
  field.score(particles, ends, scores);
  ASSERT_EQ(scores.size(), 2u);
  EXPECT_NEAR(scores[0], (0.0 + expected(1.0)) / 2.0, 1e-6);
  EXPECT_NEAR(scores[1], std::log(0.1 / kPerfect), 1e-6) << "both beams end outside the map";
}

TEST(LikelihoodField, ScoreAgreesWithOneBeamAtATime) {
  OccupancyGrid map({60, 40, 0.1, {-3, -2}}, kFree);
  for (int x = 0; x < 60; ++x) map[{x, 5}] = kOccupied;
  for (int y = 0; y < 40; ++y) map[{50, y}] = kOccupied;
  LikelihoodField field({}, map);
  RandomStream random(11, "test");
  BeamEnds ends;
  for (int i = 0; i < 37; ++i) {
    ends.x.push_back(static_cast<float>(random.uniform(-4, 4)));
    ends.y.push_back(static_cast<float>(random.uniform(-4, 4)));
  }
  ParticleSet particles;
  for (int i = 0; i < 50; ++i) {
    particles.push_back({random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(-3, 3)},
                        1.0F);
  }
  std::vector<float> scores;
  field.score(particles, ends, scores);
  int off = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    double sum = 0.0;
    for (std::size_t b = 0; b < ends.size(); ++b) {
      sum += static_cast<double>(field.log_likelihood(
          particles.pose(i) *
          Eigen::Vector2d{static_cast<double>(ends.x[b]), static_cast<double>(ends.y[b])}));
    }
    off += std::abs(static_cast<double>(scores[i]) - sum / 37.0) > 1e-4 ? 1 : 0;
  }
  EXPECT_LE(off, 1) << "float and double may put an end on a cell's edge into different cells";
}

}  // namespace
}  // namespace coop::amcl
