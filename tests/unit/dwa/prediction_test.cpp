#include "dwa/prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/dwa/test_base.hpp"

namespace coop::dwa {
namespace {

using test::test_base;

constexpr RampLimits kLimits{.acceleration = 0.5, .steering_rate = 0.8};

TEST(PredictAsPaper, FollowsEquationSixStepByStep) {
  const PredictionConfig config{.prediction_time = 1.5, .prediction_step = 0.5};
  Trajectory trajectory;
  predict_as_paper(config, {1.0, 2.0, 0.0}, {0.4, 0.2}, trajectory);
  ASSERT_EQ(trajectory.size(), 3U);
  // x += v dt cos(theta), y += v dt sin(theta), then theta += omega dt, with v dt = 0.2 m and omega
  // dt = 0.1 rad.
  EXPECT_NEAR(trajectory[0].x, 1.2, 1e-12);
  EXPECT_NEAR(trajectory[0].y, 2.0, 1e-12);
  EXPECT_NEAR(trajectory[0].yaw, 0.1, 1e-12);
  EXPECT_NEAR(trajectory[1].x, 1.2 + 0.2 * std::cos(0.1), 1e-12);
  EXPECT_NEAR(trajectory[1].y, 2.0 + 0.2 * std::sin(0.1), 1e-12);
  EXPECT_NEAR(trajectory[1].yaw, 0.2, 1e-12);
  EXPECT_NEAR(trajectory[2].x, 1.2 + 0.2 * std::cos(0.1) + 0.2 * std::cos(0.2), 1e-12);
}

TEST(PredictAsPaper, CoversThePredictionTimeOfThreeSecondsByDefault) {
  Trajectory trajectory;
  predict_as_paper({}, {}, {0.5, 0.0}, trajectory);
  EXPECT_NEAR(trajectory.back().x, 1.5, 1e-9);
}

TEST(PredictRamped, SpeedsUpNoFasterThanTheBase) {
  Trajectory trajectory;
  predict_ramped({}, test_base(), kLimits, {}, {0.0, 0.0}, {0.5, 0.0}, 1e9, trajectory);
  // One second to reach 0.5 m/s: 0.25 m, then two seconds at 0.5 m/s: 1 m.
  EXPECT_NEAR(trajectory[9].x, 0.25, 1e-9);
  EXPECT_NEAR(trajectory.back().x, 1.25, 1e-9);
}

TEST(PredictRamped, TheSteeringAngleTakesItsTime) {
  Trajectory trajectory;
  predict_ramped({}, test_base(), kLimits, {}, {0.3, 0.0}, {0.3, 0.4}, 1e9, trajectory);
  // In the first step the angle goes from 0 to 0.08 rad: 0.03 m with curvature tan(0.04) / 0.55.
  EXPECT_NEAR(trajectory[0].yaw, 0.03 * std::tan(0.04) / 0.55, 1e-9);
  // From half a second on the angle stands: the heading changes by 0.03 m * tan(0.4) / 0.55 a step.
  EXPECT_NEAR(trajectory[9].yaw - trajectory[8].yaw, 0.03 * std::tan(0.4) / 0.55, 1e-9);
}

TEST(PredictRamped, DrivesAnExactCircleAtAConstantAngle) {
  Trajectory trajectory;
  const double radius = 0.55 / std::tan(0.5);
  predict_ramped({}, test_base(), kLimits, {}, {0.3, 0.5}, {0.3, 0.5}, 1e9, trajectory);
  for (const Pose2& pose : trajectory) {
    EXPECT_NEAR(std::hypot(pose.x, pose.y - radius), radius, 1e-9);
  }
}

TEST(PredictRamped, EndsAtTheStoppingPoint) {
  Trajectory trajectory;
  predict_ramped({}, test_base(), kLimits, {}, {0.4, 0.0}, {0.4, 0.0}, 0.5, trajectory);
  EXPECT_GE(trajectory.back().x, 0.5 - 1e-9);
  EXPECT_LT(trajectory.back().x, 0.55);
}

TEST(PredictRamped, GoesBackwards) {
  Trajectory trajectory;
  predict_ramped({}, test_base(), kLimits, {}, {-0.2, 0.3}, {-0.2, 0.3}, 1e9, trajectory);
  EXPECT_LT(trajectory.back().x, 0.0);
  EXPECT_LT(trajectory.back().yaw, 0.0);  // backwards to the left the nose goes right
}

}  // namespace
}  // namespace coop::dwa
