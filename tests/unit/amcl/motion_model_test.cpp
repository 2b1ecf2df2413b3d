#include "amcl/motion_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coop::amcl {
namespace {

constexpr ArcMotionConfig kNoNoise{.distance_noise_per_distance = 0,
                                   .distance_noise_per_turn = 0,
                                   .yaw_noise_per_distance = 0,
                                   .yaw_noise_per_turn = 0,
                                   .slip_noise_per_distance = 0};

ParticleSet at_origin(std::size_t count) {
  ParticleSet particles;
  for (std::size_t i = 0; i < count; ++i) particles.push_back({0, 0, 0}, 1.0F);
  return particles;
}

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float v : values) sum += static_cast<double>(v);
  const double mean = sum / static_cast<double>(values.size());
  double squares = 0.0;
  for (const float v : values) squares += std::pow(static_cast<double>(v) - mean, 2);
  return {mean, squares / static_cast<double>(values.size())};
}

TEST(ArcMotionModel, WithoutNoiseMovesAParticleExactlyAsTheOdometry) {
  const ArcMotionModel model(kNoNoise);
  RandomStream random(1, "test");
  // A quarter circle of radius 2 about (0, 2), backwards, a bend with a sideways remainder, and a
  // turn on the spot.
  for (const Pose2 motion : {Pose2{2, 2, std::numbers::pi / 2}, Pose2{-1, 0.25, -0.5},
                             Pose2{0.3, 0.2, -0.1}, Pose2{0, 0, 2.0}}) {
    ParticleSet particles;
    const Pose2 start{3, -1, 2.5};
    particles.push_back(start, 1.0F);
    model.apply(particles, motion, random);
    const Pose2 expected = start * motion;
    EXPECT_NEAR(particles.pose(0).x, expected.x, 1e-6);
    EXPECT_NEAR(particles.pose(0).y, expected.y, 1e-6);
    EXPECT_NEAR(angle_difference(particles.pose(0).yaw, expected.yaw), 0.0, 1e-6);
  }
}

TEST(ArcMotionModel, StandingStillAddsNoNoise) {
  const ArcMotionModel model(ArcMotionConfig{});
  RandomStream random(1, "test");
  ParticleSet particles = at_origin(10);
  model.apply(particles, {0, 0, 0}, random);
  for (std::size_t i = 0; i < particles.size(); ++i) EXPECT_EQ(particles.pose(i), (Pose2{0, 0, 0}));
}

TEST(ArcMotionModel, AStraightStepHasTheDocumentedMoments) {
  const ArcMotionConfig config{.distance_noise_per_distance = 0.05,
                               .distance_noise_per_turn = 0.5,
                               .yaw_noise_per_distance = 0.04,
                               .yaw_noise_per_turn = 0.5,
                               .slip_noise_per_distance = 0.02};
  const ArcMotionModel model(config);
  RandomStream random(7, "test");
  ParticleSet particles = at_origin(200000);
  model.apply(particles, {2.0, 0.0, 0.0}, random);

  const Moments x = moments(particles.x);
  const Moments y = moments(particles.y);
  const Moments yaw = moments(particles.yaw);
  EXPECT_NEAR(x.mean, 2.0, 0.003);
  EXPECT_NEAR(y.mean, 0.0, 0.001);
  EXPECT_NEAR(yaw.mean, 0.0, 0.001);
  const double yaw_variance = 0.04 * 0.04 * 2.0;
  EXPECT_NEAR(x.variance, 0.05 * 0.05 * 2.0, 0.02 * 0.005);
  EXPECT_NEAR(yaw.variance, yaw_variance, 0.02 * yaw_variance);
  const double across = yaw_variance * 4.0 / 3.0 + 0.02 * 0.02 * 2.0;
  EXPECT_NEAR(y.variance, across, 0.02 * across);
}

TEST(ArcMotionModel, ManySmallStepsSpreadAsOneLongStepDoes) {
  const ArcMotionModel model(ArcMotionConfig{});
  RandomStream random(3, "test");
  ParticleSet one = at_origin(50000);
  ParticleSet many = at_origin(50000);
  model.apply(one, {1.0, 0.0, 0.0}, random);
  for (int i = 0; i < 20; ++i) model.apply(many, {0.05, 0.0, 0.0}, random);
  EXPECT_NEAR(moments(many.x).variance / moments(one.x).variance, 1.0, 0.05);
  EXPECT_NEAR(moments(many.y).variance / moments(one.y).variance, 1.0, 0.05);
  EXPECT_NEAR(moments(many.yaw).variance / moments(one.yaw).variance, 1.0, 0.05);
}

TEST(ArcMotionModel, TurningSpreadsTheHeading) {
  ArcMotionConfig config = kNoNoise;
  config.yaw_noise_per_turn = 0.1;
  RandomStream random(5, "test");
  ParticleSet particles = at_origin(100000);
  ArcMotionModel(config).apply(particles, {0, 0, 0.5}, random);
  EXPECT_NEAR(moments(particles.yaw).mean, 0.5, 0.002);
  EXPECT_NEAR(moments(particles.yaw).variance, 0.01 * 0.5, 0.0001);
}

TEST(ArcMotionModel, HeadingsStayFolded) {
  const ArcMotionModel model(ArcMotionConfig{});
  RandomStream random(5, "test");
  ParticleSet particles;
  for (int i = 0; i < 1000; ++i) particles.push_back({0, 0, std::numbers::pi - 1e-7 * i}, 1.0F);
  for (int i = 0; i < 20; ++i) model.apply(particles, {0.1, 0, 0.3}, random);
  for (const float yaw : particles.yaw) {
    EXPECT_GE(yaw, -std::numbers::pi_v<float>);
    EXPECT_LT(yaw, std::numbers::pi_v<float>);
  }
}

}  // namespace
}  // namespace coop::amcl
