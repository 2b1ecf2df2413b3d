#include "arm_driver/kinematic_chain.hpp"

#include <gtest/gtest.h>

#include "core/config/error.hpp"
#include "core/random.hpp"
#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver {
namespace {

using namespace test;
using Eigen::Vector3d;

KinematicChain collector_arm() {
  const auto model = collector();
  return KinematicChain(model.arm(), model.mount(robot::kArmBaseLink));
}

TEST(KinematicChain, TwoLinksOutstretchedReachTwoMetres) {
  EXPECT_TRUE(
      planar_arm().tip_in_reference(joints({0, 0})).translation().isApprox(Vector3d(2, 0, 0)));
}

TEST(KinematicChain, ElbowAtARightAngleReachesTheUnitSquaresCorner) {
  const Vector3d tip = planar_arm().tip_in_reference(joints({0, kQuarterTurn})).translation();
  EXPECT_TRUE(tip.isApprox(Vector3d(1, 1, 0), 1e-12));
}

TEST(KinematicChain, PrismaticJointMovesAlongItsAxis) {
  robot::Joint slide = revolute("slide", Vector3d::UnitZ(), {0, 0, 1});
  slide.type = robot::JointType::kPrismatic;
  const KinematicChain chain({slide});
  JacobianMatrix jacobian;
  EXPECT_TRUE(
      chain.tip_in_reference(joints({0.5}), jacobian).translation().isApprox(Vector3d(0, 0, 1.5)));
  EXPECT_TRUE(jacobian.col(0).head<3>().isApprox(Vector3d(0, 0, 1)));
  EXPECT_TRUE(jacobian.col(0).tail<3>().isZero());
}

// Column base 0.20 + 0.12 + 0.10 high, upper arm 0.36 up: the wrist is 0.78 above the floor. The
// arm's base at x = 0.45, forearm 0.36 and cup 0.18 forward: 0.99.
TEST(KinematicChain, CollectorsZeroPostureIsAsDrawn) {
  const Pose3 tip = collector_arm().tip_in_reference(JointVector::Zero(6));
  EXPECT_TRUE(tip.translation().isApprox(Vector3d(0.99, 0.0, 0.78), 1e-12));
  EXPECT_TRUE(tip.linear().col(2).isApprox(Vector3d(1, 0, 0), 1e-12)) << "the cup looks forward";
}

TEST(KinematicChain, CollectorsFirstJointSwingsTheArmToTheLeft) {
  JointVector positions = JointVector::Zero(6);
  positions[0] = kQuarterTurn;
  const Pose3 tip = collector_arm().tip_in_reference(positions);
  EXPECT_TRUE(tip.translation().isApprox(Vector3d(0.45, 0.54, 0.78), 1e-12));
}

TEST(KinematicChain, JacobianIsTheDerivativeOfTheTip) {
  const KinematicChain chain = collector_arm();
  RandomStream random(1, "postures");
  constexpr double kStep = 1e-6;
  for (int n = 0; n < 20; ++n) {
    JointVector positions(6);
    for (int i = 0; i < 6; ++i) positions[i] = random.uniform(chain.lower()[i], chain.upper()[i]);
    JacobianMatrix jacobian;
    const Pose3 tip = chain.tip_in_reference(positions, jacobian);
    for (int i = 0; i < 6; ++i) {
      JointVector moved = positions;
      moved[i] += kStep;
      const Pose3 there = chain.tip_in_reference(moved);
      const Vector3d velocity = (there.translation() - tip.translation()) / kStep;
      const Eigen::AngleAxisd turn(there.linear() * tip.linear().transpose());
      EXPECT_LT((jacobian.col(i).head<3>() - velocity).norm(), 1e-5);
      EXPECT_LT((jacobian.col(i).tail<3>() - turn.axis() * (turn.angle() / kStep)).norm(), 1e-5);
    }
  }
}

TEST(KinematicChain, LinksInParentsMultiplyToTheTip) {
  const KinematicChain chain = collector_arm();
  const JointVector positions = joints({0.1, -0.2, 0.3, -0.4, 0.5, -0.6});
  Pose3 product = collector().mount(robot::kArmBaseLink);
  for (const Pose3& pose : chain.child_in_parent(positions)) product = product * pose;
  product = product * chain.joints().back().origin;
  EXPECT_TRUE(product.isApprox(chain.tip_in_reference(positions), 1e-12));
}

TEST(KinematicChain, LimitsComeFromTheDescription) {
  const KinematicChain chain = collector_arm();
  EXPECT_DOUBLE_EQ(chain.lower()[1], -1.40);
  EXPECT_DOUBLE_EQ(chain.upper()[1], 1.75);
  EXPECT_DOUBLE_EQ(chain.max_velocity()[5], 3.5);
  JointVector positions = JointVector::Zero(6);
  EXPECT_TRUE(chain.within_limits(positions));
  positions[1] = 1.8;
  EXPECT_FALSE(chain.within_limits(positions));
}

TEST(KinematicChain, RefusesWhatIsNoArm) {
  EXPECT_THROW(KinematicChain({}), config::Error);
  robot::Joint slow = revolute("slow", Vector3d::UnitZ(), {0, 0, 0});
  slow.max_velocity = 0.0;
  EXPECT_THROW(KinematicChain({slow}), config::Error);
  EXPECT_THROW(
      KinematicChain(std::vector<robot::Joint>(9, revolute("joint", Vector3d::UnitZ(), {0, 0, 0}))),
      config::Error);
}

}  // namespace
}  // namespace coop::arm_driver
