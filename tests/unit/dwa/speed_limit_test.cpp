#include "dwa/speed_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coop::dwa {
namespace {

const SpeedConfig kConfig{.max_vel_x = 0.6,
                          .braking = 0.3,
                          .max_lateral_acceleration = 0.25,
                          .creep_speed = 0.04,
                          .narrow_clearance = 0.3,
                          .narrow_speed = 0.2};

TEST(SpeedLimit, BrakingSpeedStopsInTheDistanceLeft) {
  EXPECT_NEAR(braking_speed(kConfig, 0.15), 0.3, 1e-12);  // sqrt(2 * 0.3 * 0.15)
  EXPECT_NEAR(braking_speed(kConfig, 0.0), 0.04, 1e-12);
  EXPECT_NEAR(braking_speed(kConfig, -1.0), 0.04, 1e-12);
}

TEST(SpeedLimit, BendSpeedKeepsTheLateralAcceleration) {
  EXPECT_NEAR(bend_speed(kConfig, 0.0), 0.6, 1e-12);
  EXPECT_NEAR(bend_speed(kConfig, 1.0), 0.5, 1e-12);  // 0.5^2 * 1 = 0.25
  EXPECT_NEAR(bend_speed(kConfig, -1.0), 0.5, 1e-12);
}

TEST(SpeedLimit, NarrowSpeedFallsWithTheClearance) {
  EXPECT_NEAR(narrow_speed(kConfig, 1.0), 0.6, 1e-12);
  EXPECT_NEAR(narrow_speed(kConfig, 0.15), 0.4, 1e-12);
  EXPECT_NEAR(narrow_speed(kConfig, -0.1), 0.2, 1e-12);
}

TEST(SpeedLimit, SteeringSpeedGivesTheWheelsTime) {
  EXPECT_NEAR(steering_speed(kConfig, 0.0, 0.1, 0.8), 0.6, 1e-12);
  EXPECT_NEAR(steering_speed(kConfig, 0.4, 0.1, 0.8), 0.2, 1e-12);  // half a second for 0.1 m
  EXPECT_NEAR(steering_speed(kConfig, -0.4, 0.1, 0.8), 0.2, 1e-12);
}

}  // namespace
}  // namespace coop::dwa
