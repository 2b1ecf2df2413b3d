#include "arm_driver/inverse_kinematics.hpp"

#include <gtest/gtest.h>

#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver {
namespace {

using namespace test;
using Eigen::Vector3d;

const Vector3d kUp(0, 0, 1);
const Vector3d kDown(0, 0, -1);

InverseKinematics collector_ik() {
  const auto model = collector();
  return InverseKinematics(KinematicChain(model.arm(), model.mount(robot::kArmBaseLink)));
}

TEST(InverseKinematics, ElbowOfTwoLinksBendsByTheLawOfCosines) {
  const InverseKinematics ik(planar_arm());
  // Corner of the unit square: the elbow bends by a right angle, to the side the seed bends.
  const auto left = ik.solve({Vector3d(1, 1, 0), kUp}, joints({0.1, 1.0}));
  ASSERT_TRUE(left);
  EXPECT_NEAR((*left)[0], 0.0, 1e-3);
  EXPECT_NEAR((*left)[1], kQuarterTurn, 1e-3);
  const auto right = ik.solve({Vector3d(1, 1, 0), kUp}, joints({1.0, -1.0}));
  ASSERT_TRUE(right);
  EXPECT_NEAR((*right)[0], kQuarterTurn, 1e-3);
  EXPECT_NEAR((*right)[1], -kQuarterTurn, 1e-3);
}

TEST(InverseKinematics, FartherThanTheLinksAreLongIsOutOfReach) {
  const InverseKinematics ik(planar_arm());
  const auto solution = ik.solve({Vector3d(2.1, 0, 0), kUp}, joints({0, 0.1}));
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error(), IkError::kOutOfReach);
}

TEST(InverseKinematics, BehindTheLimitsIsAJointLimit) {
  const InverseKinematics ik(planar_arm(0.5));
  const auto solution = ik.solve({Vector3d(-1, 1, 0), kUp}, joints({0, 0.1}));
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error(), IkError::kJointLimit);
}

TEST(InverseKinematics, WrongDirectionIsNoSolution) {
  const InverseKinematics ik(planar_arm());
  EXPECT_FALSE(ik.solve({Vector3d(1, 1, 0), kDown}, joints({0.1, 1.0})));
}

TEST(InverseKinematics, EveryPointOfTheWorkingRegionIsReachedWithinTheLimits) {
  const InverseKinematics ik = collector_ik();
  const JointVector seed = joints({0.0, -0.9, 1.0, 0.0, 1.2, 0.0});
  int points = 0;
  for (double x = 0.80; x < 1.041; x += 0.02) {
    for (double y = -0.15; y < 0.151; y += 0.025) {
      for (const double z : {0.045, 0.10, 0.165}) {
        const auto solution = ik.solve({Vector3d(x, y, z), kDown}, seed);
        ASSERT_TRUE(solution) << x << ' ' << y << ' ' << z << ": " << to_string(solution.error());
        EXPECT_TRUE(ik.chain().within_limits(*solution));
        const Pose3 tip = ik.chain().tip_in_reference(*solution);
        EXPECT_LT((tip.translation() - Vector3d(x, y, z)).norm(), 1e-4);
        EXPECT_GT(tip.linear().col(2).dot(kDown), std::cos(1e-3));
        ++points;
      }
    }
  }
  EXPECT_EQ(points, 13 * 13 * 3);
}

TEST(InverseKinematics, NeighbouringPointsHaveNeighbouringPostures) {
  const InverseKinematics ik = collector_ik();
  const JointVector home = joints({0.0, -0.9, 1.0, 0.0, 1.2, 0.0});
  const auto first = ik.solve({Vector3d(0.92, -0.15, 0.045), kDown}, home);
  ASSERT_TRUE(first);
  JointVector last = *first;
  for (double y = -0.14; y < 0.151; y += 0.01) {
    const auto solution = ik.solve({Vector3d(0.92, y, 0.045), kDown}, home);
    ASSERT_TRUE(solution);
    EXPECT_LT((*solution - last).cwiseAbs().maxCoeff(), 0.1) << y;
    last = *solution;
  }
}

TEST(InverseKinematics, SameQuestionHasTheSameAnswerToTheBit) {
  const JointVector seed = joints({2.0, 1.0, -1.0, 2.0, -1.0, 1.0});
  const TipTarget target{Vector3d(0.9, 0.1, 0.05), kDown};
  const auto one = collector_ik().solve(target, seed);
  const auto two = collector_ik().solve(target, seed);
  ASSERT_TRUE(one);
  ASSERT_TRUE(two);
  EXPECT_EQ(*one, *two);
}

TEST(InverseKinematics, FarEggIsOutOfReach) {
  const auto solution =
      collector_ik().solve({Vector3d(1.6, 0, 0.045), kDown}, JointVector::Zero(6));
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error(), IkError::kOutOfReach);
}

}  // namespace
}  // namespace coop::arm_driver
