#include "arm_driver/simulated_arm.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.hpp"
#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver {
namespace {

using namespace test;

Time at(double time) {
  return time_from_seconds(time);
}

TEST(SimulatedArm, TurnsNoFasterThanItsJointsCan) {
  SimulatedArm arm(planar_arm(), joints({0, 0}));  // 2 rad/s
  arm.command(joints({1, -1}), false, at(1.00));
  arm.command(joints({1, -1}), false, at(1.02));
  EXPECT_TRUE(arm.read(at(1.02)).positions.isApprox(joints({0.04, -0.04}), 1e-9));
  EXPECT_TRUE(arm.read(at(1.02)).velocities.isApprox(joints({2, -2}), 1e-6));
}

TEST(SimulatedArm, StopsAtTheJointsLimits) {
  SimulatedArm arm(planar_arm(0.5), joints({0.4, 0}));
  for (int i = 0; i < 20; ++i) arm.command(joints({3, 0}), false, at(1 + 0.05 * i));
  EXPECT_DOUBLE_EQ(arm.read(at(2)).positions[0], 0.5);
}

TEST(SimulatedArm, DoesNotJumpAfterAPauseOrWhenTimeIsSetBack) {
  SimulatedArm arm(planar_arm(), joints({0, 0}));
  arm.command(joints({3, 0}), false, at(1));
  arm.command(joints({3, 0}), false, at(100));
  EXPECT_LE(arm.read(at(100)).positions[0], 0.2 + 1e-9);
  const double before = arm.read(at(100)).positions[0];
  arm.command(joints({3, 0}), false, at(50));
  EXPECT_EQ(arm.read(at(50)).positions[0], before);
}

TEST(SimulatedArm, KnowsTheVacuumOnlyFromFreshTruth) {
  SimulatedArm arm(planar_arm(), joints({0, 0}));
  EXPECT_FALSE(arm.read(at(1)).vacuum.has_value());
  arm.hear_truth(false, at(1));
  EXPECT_EQ(arm.read(at(1.1)).vacuum, false);
  arm.hear_truth(true, at(2));
  EXPECT_EQ(arm.read(at(2.1)).vacuum, true);
  EXPECT_FALSE(arm.read(at(2.6)).vacuum.has_value());
  arm.hear_truth(true, at(3));
  EXPECT_FALSE(arm.read(at(1)).vacuum.has_value()) << "heard in a time to come";
}

TEST(SimulatedArm, MeasuresAWeakVacuumOnTheOpenCupAndAStrongOneOnAnEgg) {
  SimulatedArm arm(planar_arm(), joints({0, 0}));
  arm.hear_truth(false, at(1));
  EXPECT_EQ(arm.read(at(1)).vacuum_kpa, 0.0);
  arm.command(joints({0, 0}), true, at(1));
  const double open = arm.read(at(1)).vacuum_kpa;
  arm.hear_truth(true, at(1));
  EXPECT_GT(open, 0.0);
  EXPECT_GT(arm.read(at(1)).vacuum_kpa, 5 * open);
}

TEST(SimulatedArm, KeepsPostureAndPumpWhileTheDriverIsAway) {
  const coop::test::TemporaryFolder folder;
  const auto file = folder.path() / "run" / "posture";
  JointVector left;
  {
    SimulatedArm arm(planar_arm(), joints({0, 0}), file);
    for (int i = 0; i < 5; ++i) arm.command(joints({3, -1}), true, at(1 + 0.02 * i));
    left = arm.read(at(2)).positions;
    EXPECT_NE(left, joints({0, 0}));
  }
  SimulatedArm arm(planar_arm(), joints({0, 0}), file);
  EXPECT_EQ(arm.read(at(2)).positions, left);
  EXPECT_TRUE(arm.read(at(2)).suction);
}

TEST(SimulatedArm, StartsAnewWhereTheMemoryIsSpoilt) {
  const coop::test::TemporaryFolder folder;
  const auto file = folder.path() / "posture";
  { SimulatedArm arm(planar_arm(), joints({0.3, 0}), file); }
  {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(20);
    stream.write("spoilt", 6);
  }
  SimulatedArm arm(planar_arm(), joints({0.1, 0}), file);
  EXPECT_EQ(arm.read(at(1)).positions, joints({0.1, 0}));
}

}  // namespace
}  // namespace coop::arm_driver
