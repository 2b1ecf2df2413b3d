#include "slam/motion_noise.hpp"

#include <gtest/gtest.h>

namespace coop::slam {
namespace {

constexpr MotionNoiseConfig kNoise{.position_per_distance = 0.1,
                                   .position_per_turn = 0.2,
                                   .yaw_per_distance = 0.3,
                                   .yaw_per_turn = 0.4,
                                   .min_position = 0.03,
                                   .min_yaw = 0.02};

TEST(MotionNoise, HasItsFloorWithoutMotion) {
  const auto stddev = motion_stddev(kNoise, {});
  EXPECT_DOUBLE_EQ(stddev.x(), 0.03);
  EXPECT_DOUBLE_EQ(stddev.y(), 0.03);
  EXPECT_DOUBLE_EQ(stddev.z(), 0.02);
}

TEST(MotionNoise, VariancesOfDistanceAndTurnAddUp) {
  const auto stddev = motion_stddev(kNoise, {3.0, 4.0, -0.5});  // 5 m, half a radian
  EXPECT_NEAR(stddev.x(), std::sqrt(0.01 * 5 + 0.04 * 0.5 + 0.0009), 1e-12);
  EXPECT_NEAR(stddev.z(), std::sqrt(0.09 * 5 + 0.16 * 0.5 + 0.0004), 1e-12);
}

TEST(MotionNoise, OneStepIsAsUncertainAsTheSameWayInManyBeyondTheFloor) {
  MotionNoiseConfig config = kNoise;
  config.min_position = config.min_yaw = 0.0;
  const auto whole = motion_stddev(config, {1.0, 0.0, 0.2});
  const auto tenth = motion_stddev(config, {0.1, 0.0, 0.02});
  EXPECT_NEAR(whole.x() * whole.x(), 10.0 * tenth.x() * tenth.x(), 1e-12);
  EXPECT_NEAR(whole.z() * whole.z(), 10.0 * tenth.z() * tenth.z(), 1e-12);
}

TEST(MotionNoise, IsWideWhereOdometryWasRestarted) {
  MotionNoiseConfig config;
  config.min_position = 0.03;
  config.min_yaw = 0.05;
  config.restart_position = 0.4;
  config.restart_yaw = 0.12;
  const Eigen::Vector3d stddev = motion_stddev(config, {}, true);
  EXPECT_NEAR(stddev.x(), std::hypot(0.03, 0.4), 1e-12);
  EXPECT_NEAR(stddev.y(), stddev.x(), 1e-12);
  EXPECT_NEAR(stddev.z(), 0.13, 1e-12);
}

}  // namespace
}  // namespace coop::slam
