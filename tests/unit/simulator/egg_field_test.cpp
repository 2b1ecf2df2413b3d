#include "simulator/egg_field.hpp"

#include <gtest/gtest.h>

#include "core/world/shapes.hpp"
#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector3d;
using world::EggState;

constexpr double kFloor = world::kEggHalfWidth;
constexpr double kTop = 2 * world::kEggHalfWidth;
/// The robot stands at the origin of world throughout, heading along x: base_link is world.
const Pose2 kOrigin{};

class EggFieldTest : public testing::Test {
 protected:
  const world::Egg& step(bool suction, const Vector3d& tip, const Pose2& robot = kOrigin) {
    field_.step(robot, 0.0, {suction, tip});
    return field_.eggs()[0];
  }

  EggField field_{{},
                  test::robot(),
                  {{"near", {0.85, 0.0, kFloor}, EggState::kOnFloor},
                   {"far", {3.0, 1.0, kFloor}, EggState::kOnFloor}}};
};

TEST_F(EggFieldTest, SuctionTakesTheEggWithinReachOfTheCup) {
  EXPECT_EQ(step(true, {0.85, 0.0, 0.30}).state, EggState::kOnFloor);  // too high
  EXPECT_EQ(step(true, {0.88, 0.0, kTop}).state, EggState::kOnFloor);  // 3 cm beside it
  EXPECT_EQ(step(true, {0.85, 0.0, kTop + 0.031}).state, EggState::kOnFloor);
  EXPECT_EQ(step(false, {0.85, 0.0, kTop}).state, EggState::kOnFloor);  // no suction
  EXPECT_EQ(step(true, {0.87, 0.01, kTop + 0.02}).state, EggState::kInGripper);
}

TEST_F(EggFieldTest, AHeldEggHangsBelowTheCupAndGoesWithArmAndRobot) {
  step(true, {0.85, 0.0, kTop});
  EXPECT_TRUE(step(true, {0.60, 0.1, 0.40}).position.isApprox(Vector3d(0.60, 0.1, 0.40 - kFloor)));
  const Pose2 robot{2.0, 1.0, M_PI / 2};
  EXPECT_TRUE(step(true, {0.60, 0.1, 0.40}, robot)
                  .position.isApprox(Vector3d(2.0 - 0.1, 1.0 + 0.60, 0.40 - kFloor)));
}

TEST_F(EggFieldTest, AnEggReleasedOverTheBasketIsCollectedAndTravelsWithTheRobot) {
  step(true, {0.85, 0.0, kTop});
  step(true, {0.0, 0.1, 0.36});
  EXPECT_EQ(step(false, {0.0, 0.1, 0.36}).state, EggState::kCollected);
  const world::Egg& egg = step(false, {0.5, 0.0, 0.5}, {3.0, 2.0, 0.0});
  EXPECT_TRUE(egg.position.isApprox(Vector3d(3.0, 2.1, 0.2 + kFloor)));
  EXPECT_EQ(egg.state, EggState::kCollected);
}

TEST_F(EggFieldTest, AnEggDroppedFromAHeightBreaksWhereItFalls) {
  step(true, {0.85, 0.0, kTop});
  step(true, {1.0, 0.2, 0.40});
  const world::Egg& egg = step(false, {1.0, 0.2, 0.40});
  EXPECT_EQ(egg.state, EggState::kBroken);
  EXPECT_TRUE(egg.position.isApprox(Vector3d(1.0, 0.2, kFloor)));
}

TEST_F(EggFieldTest, AnEggSetDownGentlyStaysWholeAndCanBeTakenAgain) {
  step(true, {0.85, 0.0, kTop});
  step(true, {0.90, 0.1, kTop + 0.04});
  EXPECT_EQ(step(false, {0.90, 0.1, kTop + 0.04}).state, EggState::kOnFloor);
  EXPECT_TRUE(field_.eggs()[0].position.isApprox(Vector3d(0.90, 0.1, kFloor)));
  EXPECT_EQ(step(true, {0.90, 0.1, kTop}).state, EggState::kInGripper);
}

TEST_F(EggFieldTest, AWheelThatRollsOverAnEggBreaksIt) {
  // The rear left wheel stands at (0, 0.2): drive so that it comes over the egg at (0.85, 0).
  EXPECT_EQ(step(false, {0, 0, 1}, {0.85, -0.26, 0.0}).state, EggState::kOnFloor);  // beside it
  EXPECT_EQ(step(false, {0, 0, 1}, {0.85, -0.24, 0.0}).state, EggState::kBroken);
}

TEST_F(EggFieldTest, ASteeredWheelTurnsItsPatchOfFloor) {
  // The egg lies 4.5 cm ahead of and beside the front left wheel: within the straight patch's
  // corner.
  const Pose2 robot{0.85 - 0.5 - 0.045, -0.2 - 0.045, 0.0};
  field_.step(robot, 0.0, {});
  const bool straight_hit = field_.eggs()[0].state == EggState::kBroken;
  EggField turned({}, test::robot(), {{"near", {0.85, 0.0, kFloor}, EggState::kOnFloor}});
  turned.step(robot, M_PI / 4, {});
  EXPECT_TRUE(straight_hit);
  EXPECT_EQ(turned.eggs()[0].state, EggState::kOnFloor);
}

TEST_F(EggFieldTest, TheRobotsBodyPassesOverEggsWithoutHarm) {
  EXPECT_EQ(step(false, {0, 0, 1}, {0.6, 0.0, 0.0}).state, EggState::kOnFloor);
}

TEST_F(EggFieldTest, OneEggAtATime) {
  EggField field({}, test::robot(),
                 {{"a", {0.85, 0.0, kFloor}, EggState::kOnFloor},
                  {"b", {0.86, 0.0, kFloor}, EggState::kOnFloor}});
  field.step(kOrigin, 0.0, {true, {0.858, 0.0, kTop}});
  EXPECT_EQ(field.eggs()[0].state, EggState::kOnFloor);
  EXPECT_EQ(field.eggs()[1].state, EggState::kInGripper);  // the nearer one
}

TEST_F(EggFieldTest, BrokenEggsCannotBeTaken) {
  step(true, {0.85, 0.0, kTop});
  step(false, {0.85, 0.0, 0.50});
  EXPECT_EQ(step(true, {0.85, 0.0, kTop}).state, EggState::kBroken);
}

}  // namespace
}  // namespace coop::simulator
