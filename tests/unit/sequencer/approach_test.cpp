#include "sequencer/approach.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coop::sequencer {
namespace {

constexpr double kPi = std::numbers::pi;

std::optional<double> anywhere(const Pose2&) {
  return 1.0;
}

TEST(ApproachTest, EquationFourPutsThePoseOnTheLineToTheEgg) {
  const Pose2 pose = approach_pose({0, 0}, {3, 4}, 1.0);
  EXPECT_NEAR(pose.x, 2.4, 1e-12);
  EXPECT_NEAR(pose.y, 3.2, 1e-12);
  EXPECT_NEAR(pose.yaw, std::atan2(4, 3), 1e-12);
}

TEST(ApproachTest, TheDirectPoseIsTakenWhereItIsFree) {
  const auto pose = choose_approach({0, 0, 0}, {3, 0}, {}, anywhere);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x, 3 - 0.92, 1e-12);
  EXPECT_NEAR(pose->yaw, 0, 1e-12);
}

TEST(ApproachTest, WhereItIsBlockedTheCheapestOnTheCircleIsTaken) {
  const auto cost = [](const Pose2& pose) -> std::optional<double> {
    if (pose.x < 3) return std::nullopt;           // this side of the egg is blocked
    return std::hypot(pose.x - 3, pose.y - 0.92);  // cheapest straight above the egg
  };
  const auto pose = choose_approach({0, 0, 0}, {3, 0}, {}, cost);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->y, 0.92, 1e-9);
  EXPECT_NEAR(pose->yaw, -kPi / 2, 1e-9);
}

TEST(ApproachTest, HeadingsTriedInVainAreAvoided) {
  const auto pose = choose_approach({0, 0, 0}, {3, 0}, {}, anywhere, {0.0});
  ASSERT_TRUE(pose);
  EXPECT_GE(std::abs(pose->yaw), 0.35);
}

TEST(ApproachTest, WhereNothingIsFreeThereIsNoPose) {
  EXPECT_FALSE(
      choose_approach({0, 0, 0}, {3, 0}, {}, [](const Pose2&) { return std::optional<double>(); }));
}

TEST(ApproachTest, ReachIsABoxAroundTheWorkingPoint) {
  EXPECT_TRUE(is_within_reach({0, 0, 0}, {0.92, 0.11}, {}));
  EXPECT_FALSE(is_within_reach({0, 0, 0}, {0.92, 0.13}, {}));
  EXPECT_FALSE(is_within_reach({0, 0, 0}, {1.03, 0}, {}));
  EXPECT_TRUE(is_within_reach({1, 1, kPi / 2}, {1, 1.92}, {}));
}

}  // namespace
}  // namespace coop::sequencer
