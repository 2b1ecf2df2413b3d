#include "arm_driver/arm_motion.hpp"

#include <gtest/gtest.h>

#include "core/config/error.hpp"
#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver {
namespace {

using namespace test;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kEgg(0.92, 0.0);

Eigen::AlignedBox3d box_of(const robot::RobotModel& model, std::string_view link) {
  const auto& shape = model.link(link).collision.at(0);
  const Vector3d center = (model.mount(link) * shape.in_link).translation();
  return {center - 0.5 * shape.size, center + 0.5 * shape.size};
}

TEST(ArmMotion, FoldsTheArmOverTheDeckAtHome) {
  const auto model = collector();
  const ArmMotion motion(model, {});
  const Vector3d tip = motion.tip(motion.home());
  const auto base = box_of(model, robot::kBaseLink);
  EXPECT_TRUE(
      Eigen::AlignedBox2d(base.min().head<2>(), base.max().head<2>()).contains(tip.head<2>()));
  EXPECT_GT(tip.z(), model.mount(robot::kLaserLink).translation().z() + 0.05)
      << "out of the laser's plane";
}

TEST(ArmMotion, ReleasesAtTheOriginOfTheBasketWithTheCupDown) {
  const auto model = collector();
  const ArmMotion motion(model, {});
  const Vector3d release = model.mount(robot::kBasketLink).translation();
  EXPECT_LT((motion.tip(motion.at_basket()) - release).norm(), 1e-3);
  const Vector3d above = motion.tip(motion.above_basket());
  EXPECT_LT((above - release - Vector3d(0, 0, motion.config().basket_clearance)).norm(), 1e-3);
}

TEST(ArmMotion, TouchesThePlaceItselfFirstThenAroundIt) {
  const ArmMotion motion(collector(), {});
  const auto touches = motion.touches(kEgg);
  ASSERT_TRUE(touches);
  ASSERT_EQ(touches->size(), 7U);
  EXPECT_TRUE((*touches)[0].isApprox(Vector3d(0.92, 0, 0.045)));
  Vector3d sum(0, 0, 0);
  for (std::size_t i = 1; i < 7; ++i) {
    EXPECT_NEAR(((*touches)[i] - (*touches)[0]).norm(), 0.030, 1e-12);
    sum += (*touches)[i] - (*touches)[0];
    for (std::size_t k = 1; k < i; ++k) EXPECT_GT(((*touches)[i] - (*touches)[k]).norm(), 0.029);
  }
  EXPECT_LT(sum.norm(), 1e-12) << "evenly spread";
}

TEST(ArmMotion, LowersTheCupInAStraightLine) {
  const ArmMotion motion(collector(), {});
  for (const Vector2d& egg : {kEgg, Vector2d(0.80, -0.15), Vector2d(1.04, 0.15)}) {
    const auto above = motion.posture_at(Vector3d(egg.x(), egg.y(), 0.165));
    ASSERT_TRUE(above);
    const auto descent = motion.straight_to(*above, Vector3d(egg.x(), egg.y(), 0.045));
    EXPECT_LT(descent.duration(), 1.2);
    for (double t = 0; t <= descent.duration(); t += 0.02) {
      const Pose3 tip = motion.chain().tip_in_reference(descent.at(t).positions);
      EXPECT_LT((tip.translation().head<2>() - egg).norm(), 0.002);
      EXPECT_LT(tip.linear().col(2).z(), -0.999);
    }
    EXPECT_NEAR(motion.tip(descent.goal()).z(), 0.045, 2e-4);
  }
}

TEST(ArmMotion, CarriesTheEggClearOfBaseAndBasket) {
  constexpr double kEggWidth = 0.046;
  const auto model = collector();
  const ArmMotion motion(model, {});
  auto obstacles = {box_of(model, robot::kBaseLink), box_of(model, robot::kBasketLink)};
  for (const Vector2d& egg : {kEgg, Vector2d(0.80, -0.15), Vector2d(1.04, 0.15)}) {
    const auto lifted = motion.posture_at(Vector3d(egg.x(), egg.y(), 0.205));
    ASSERT_TRUE(lifted);
    const auto carry = motion.to(*lifted, motion.above_basket());
    for (double t = 0; t <= carry.duration(); t += 0.02) {
      const Vector3d tip = motion.tip(carry.at(t).positions);
      const Vector3d half(kEggWidth / 2, kEggWidth / 2, 0);
      const Eigen::AlignedBox3d body(tip - half - Vector3d(0, 0, kEggWidth), tip + half);
      for (const auto& obstacle : obstacles) {
        EXPECT_FALSE(obstacle.intersects(body)) << tip.transpose();
      }
      EXPECT_TRUE(motion.chain().within_limits(carry.at(t).positions));
    }
  }
}

TEST(ArmMotion, KeepsTheCupAwayFromTheLaser) {
  const auto model = collector();
  const ArmMotion motion(model, {});
  const Vector3d laser = model.mount(robot::kLaserLink).translation();
  const auto above = motion.posture_at(Vector3d(0.92, 0, 0.165));
  ASSERT_TRUE(above);
  for (const auto& way : {motion.to(motion.home(), *above), motion.to(*above, motion.home()),
                          motion.to(motion.at_basket(), motion.home())}) {
    for (double t = 0; t <= way.duration(); t += 0.02) {
      EXPECT_GT((motion.tip(way.at(t).positions) - laser).norm(), 0.06);
    }
  }
}

TEST(ArmMotion, TellsWhyAnEggCannotBeReached) {
  const ArmMotion motion(collector(), {});
  const auto far = motion.touches({2.0, 0.0});
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error(), IkError::kOutOfReach);
}

TEST(ArmMotion, RefusesAHomeThatIsNoPosture) {
  ArmMotionConfig config;
  config.home = {0.0, 0.0};
  EXPECT_THROW(ArmMotion(collector(), config), config::Error);
  config.home = {0.0, 5.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_THROW(ArmMotion(collector(), config), config::Error);
}

}  // namespace
}  // namespace coop::arm_driver
