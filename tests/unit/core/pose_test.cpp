#include "core/pose.hpp"

#include <gtest/gtest.h>

namespace coop {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(PoseTest, AnglesFoldIntoHalfOpenTurn) {
  EXPECT_DOUBLE_EQ(normalize_angle(kPi), -kPi);
  EXPECT_DOUBLE_EQ(normalize_angle(-kPi), -kPi);
  EXPECT_NEAR(normalize_angle(5 * kPi / 2), kPi / 2, 1e-12);
  EXPECT_NEAR(normalize_angle(-7 * kPi / 2), kPi / 2, 1e-12);
  EXPECT_NEAR(angle_difference(-3.0, 3.0), 2 * kPi - 6.0, 1e-12);
}

TEST(PoseTest, APoseFacingLeftSeesForwardAsLeft) {
  const Pose2 robot_in_map{1, 2, kPi / 2};
  const Pose2 egg_in_robot{3, 0, 0};
  const Pose2 egg_in_map = robot_in_map * egg_in_robot;
  EXPECT_NEAR(egg_in_map.x, 1, 1e-12);
  EXPECT_NEAR(egg_in_map.y, 5, 1e-12);
  EXPECT_NEAR(egg_in_map.yaw, kPi / 2, 1e-12);
}

TEST(PoseTest, APoseTimesItsInverseIsNothing) {
  const Pose2 pose{3, -4, 2.5};
  const Pose2 identity = pose * pose.inverse();
  EXPECT_NEAR(identity.x, 0, 1e-12);
  EXPECT_NEAR(identity.y, 0, 1e-12);
  EXPECT_NEAR(identity.yaw, 0, 1e-12);
}

TEST(PoseTest, InterpolationTurnsTheShortWay) {
  const Pose2 middle = interpolate({0, 0, 3.0}, {2, 4, -3.0}, 0.5);
  EXPECT_DOUBLE_EQ(middle.x, 1);
  EXPECT_DOUBLE_EQ(middle.y, 2);
  EXPECT_NEAR(std::abs(middle.yaw), kPi, 1e-12);
}

TEST(PoseTest, TheFloorProjectionOfASpatialPoseIsThePlanarPose) {
  const Pose2 pose{1, 2, 0.5};
  const Pose2 back = to_pose2(to_pose3(pose));
  EXPECT_NEAR(back.x, 1, 1e-12);
  EXPECT_NEAR(back.y, 2, 1e-12);
  EXPECT_NEAR(back.yaw, 0.5, 1e-12);
}

}  // namespace
}  // namespace coop
