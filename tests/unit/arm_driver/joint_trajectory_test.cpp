#include "arm_driver/joint_trajectory.hpp"

#include <gtest/gtest.h>

#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver {
namespace {

using namespace test;

MotionLimits limits(const std::vector<double>& velocity, const std::vector<double>& acceleration) {
  return {joints(velocity), joints(acceleration)};
}

/// Checks speeds and accelerations by differences of the positions.
void expect_within_limits(const JointTrajectory& trajectory, const MotionLimits& limits) {
  constexpr double kStep = 1e-3;
  for (double t = kStep; t < trajectory.duration(); t += kStep) {
    const JointVector before = trajectory.at(t - kStep).positions;
    const JointVector here = trajectory.at(t).positions;
    const JointVector after = trajectory.at(t + kStep).positions;
    const JointVector velocity = (after - before) / (2 * kStep);
    const JointVector acceleration = (after - 2 * here + before) / (kStep * kStep);
    ASSERT_TRUE((velocity.array().abs() <= limits.velocity.array() + 1e-6).all()) << t;
    ASSERT_TRUE((acceleration.array().abs() <= limits.acceleration.array() + 1e-4).all()) << t;
    ASSERT_LT((velocity - trajectory.at(t).velocities).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(JointTrajectory, StartsAndEndsAtRestWhereItShould) {
  const JointTrajectory motion({joints({0, 1}), joints({1, -1})}, limits({1, 1}, {10, 10}));
  EXPECT_EQ(motion.at(-1.0).positions, joints({0, 1}));
  EXPECT_EQ(motion.at(0.0).positions, joints({0, 1}));
  EXPECT_TRUE(motion.at(motion.duration()).positions.isApprox(joints({1, -1})));
  EXPECT_TRUE(motion.at(99.0).positions.isApprox(joints({1, -1})));
  EXPECT_TRUE(motion.at(0.0).velocities.isZero());
  EXPECT_TRUE(motion.at(motion.duration()).velocities.isZero(1e-12));
  EXPECT_TRUE(motion.at(motion.duration() / 2).positions.isApprox(joints({0.5, 0}), 1e-9));
}

// 2 rad at 1 rad/s take 2 s and, the ramps being 1.5 * 1 / 100 s long, 15 ms more.
TEST(JointTrajectory, LastsAsLongAsTheSlowestJointNeeds) {
  const JointTrajectory motion({joints({0, 0}), joints({2, 1})}, limits({1, 1}, {100, 100}));
  EXPECT_NEAR(motion.duration(), 2.015, 1e-9);
}

// Two ramps that meet: 1 rad = V R, and R = 1.5 V / (1 rad/s2), so V = sqrt(1/1.5), 2 R = sqrt(6).
TEST(JointTrajectory, LastsLongerWhereTheAccelerationIsTheLimit) {
  const JointTrajectory motion({joints({0}), joints({1})}, limits({100}, {1}));
  EXPECT_NEAR(motion.duration(), std::sqrt(6.0), 1e-9);
  EXPECT_NEAR(motion.at(motion.duration() / 2).velocities[0], std::sqrt(1 / 1.5), 1e-9);
}

TEST(JointTrajectory, KeepsTheLimitsOfEveryJoint) {
  const MotionLimits both = limits({1.0, 0.5}, {4.0, 3.0});
  expect_within_limits(JointTrajectory({joints({0, 0}), joints({1, -2})}, both), both);
  expect_within_limits(
      JointTrajectory(
          {joints({0, 0}), joints({0.3, -0.2}), joints({0.5, -0.5}), joints({0.6, -0.9})}, both),
      both);
}

TEST(JointTrajectory, GoesThroughThePositionsOfItsPath) {
  const JointTrajectory motion({joints({0}), joints({1}), joints({1.5})}, limits({1}, {10}));
  EXPECT_NEAR(motion.at(motion.duration() / 2).positions[0], 1.0, 1e-9);
}

TEST(JointTrajectory, ToWhereTheArmIsTakesNoTime) {
  const JointTrajectory motion({joints({1}), joints({1})}, limits({1}, {10}));
  EXPECT_EQ(motion.duration(), 0.0);
  EXPECT_EQ(motion.at(0.0).positions, joints({1}));
  EXPECT_EQ(JointTrajectory({joints({1})}, limits({1}, {10})).at(3.0).positions, joints({1}));
}

}  // namespace
}  // namespace coop::arm_driver
