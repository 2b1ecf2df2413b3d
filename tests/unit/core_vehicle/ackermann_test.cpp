#include "core/vehicle/ackermann.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "unit/core_vehicle/base.hpp"

namespace coop::vehicle {
namespace {

using test::kBase;

TEST(Ackermann, SteeringOf45DegreesTurnsOnACircleOfTheWheelbase) {
  EXPECT_NEAR(curvature_of(kBase, std::numbers::pi / 4), 1.0 / 0.5, 1e-12);
  const Twist2 twist = twist_of(kBase, 0.3, std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(twist.v, 0.3);
  EXPECT_NEAR(twist.omega, 0.6, 1e-12);
}

TEST(Ackermann, SteeringFollowsFromTheTwistForwardAndBackward) {
  AckermannGeometry wide = kBase;
  wide.max_steering_angle = 1.0;
  EXPECT_NEAR(steering_of(wide, {0.3, 0.6}, 0.0), std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(steering_of(wide, {-0.3, -0.6}, 0.0), std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(steering_of(wide, {-0.3, 0.6}, 0.0), -std::numbers::pi / 4, 1e-12);
}

TEST(Ackermann, ATurnTighterThanTheSteeringAllowsGetsTheLimit) {
  EXPECT_DOUBLE_EQ(steering_of(kBase, {0.1, 5.0}, 0.0), 0.6);
  EXPECT_DOUBLE_EQ(steering_of(kBase, {0.1, -5.0}, 0.0), -0.6);
}

TEST(Ackermann, StandstillLeavesTheSteeringAsItIs) {
  EXPECT_DOUBLE_EQ(steering_of(kBase, {0.0, 0.4}, 0.21), 0.21);
}

TEST(Ackermann, WheelsRollOnCirclesAboutOneCentre) {
  // Left turn about a centre 1 m to the left of base_link: rear wheels on circles of 0.8 and 1.2 m.
  const double steering = steering_of_curvature(kBase, 1.0);
  const WheelSpeeds wheels = wheel_speeds(kBase, 1.0, steering);
  EXPECT_NEAR(wheels.rear_left, 0.8, 1e-12);
  EXPECT_NEAR(wheels.rear_right, 1.2, 1e-12);
  EXPECT_NEAR(wheels.front_left, std::hypot(0.8, 0.5), 1e-12);
  EXPECT_NEAR(wheels.front_right, std::hypot(1.2, 0.5), 1e-12);
  const FrontWheelAngles angles = front_wheel_angles(kBase, steering);
  EXPECT_NEAR(std::tan(angles.left), 0.5 / 0.8, 1e-12);
  EXPECT_NEAR(std::tan(angles.right), 0.5 / 1.2, 1e-12);
}

TEST(Ackermann, AQuarterCircleEndsWhereItMust) {
  // Radius 2 m to the left from the origin along x: centre (0, 2), end (2, 2) facing y.
  const Pose2 end = advance_along_arc({0, 0, 0}, std::numbers::pi, std::numbers::pi / 2);
  EXPECT_NEAR(end.x, 2.0, 1e-12);
  EXPECT_NEAR(end.y, 2.0, 1e-12);
  EXPECT_NEAR(end.yaw, std::numbers::pi / 2, 1e-12);
}

TEST(Ackermann, ManySmallArcsMakeTheSameCircleAsOne) {
  Pose2 pose{1.0, -1.0, 0.3};
  const Pose2 once = advance_along_arc(pose, 3.0, 2.0);
  for (int i = 0; i < 3000; ++i) pose = advance_along_arc(pose, 0.001, 2.0 / 3000);
  EXPECT_NEAR(pose.x, once.x, 1e-10);
  EXPECT_NEAR(pose.y, once.y, 1e-10);
  EXPECT_NEAR(pose.yaw, once.yaw, 1e-10);
}

TEST(Ackermann, ArcsOfVanishingTurnMeetTheStraightLine) {
  const Pose2 straight = advance_along_arc({0, 0, 0}, 5.0, 0.0);
  EXPECT_DOUBLE_EQ(straight.x, 5.0);
  EXPECT_DOUBLE_EQ(straight.y, 0.0);
  for (const double turn : {1e-3, 1.9e-4, 2.1e-4, 1e-8}) {  // both sides of the series' limit
    const Pose2 end = advance_along_arc({0, 0, 0}, 5.0, turn);
    EXPECT_NEAR(end.x, 5.0 * std::sin(turn) / turn, 1e-12);
    EXPECT_NEAR(end.y, 5.0 * (2 * std::sin(turn / 2) * std::sin(turn / 2)) / turn, 1e-12);
  }
}

TEST(Ackermann, DrivingBackAlongTheArcReturnsToTheStart) {
  const Pose2 start{0.4, 0.7, 2.9};
  const Pose2 there = advance_along_arc(start, 1.3, 0.8);
  const Pose2 back = advance_along_arc(there, -1.3, -0.8);
  EXPECT_NEAR(back.x, start.x, 1e-12);
  EXPECT_NEAR(back.y, start.y, 1e-12);
  EXPECT_NEAR(back.yaw, start.yaw, 1e-12);
}

}  // namespace
}  // namespace coop::vehicle
