#include "dwa/dwa.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "unit/dwa/test_base.hpp"

namespace coop::dwa {
namespace {

using test::kBaseFootprint;
using test::kSteeringRate;
using test::test_base;

/// Dwa on a base that does at once what it is told, with a laser that sees nothing unless told
/// otherwise.
class DwaTest : public testing::Test {
 protected:
  explicit DwaTest(const DwaConfig& config = {})
      : dwa_(config, kBaseFootprint, test_base(), kSteeringRate) {}

  /// One control step of 50 ms; odom and map are the same frame.
  DwaOutput step() {
    now_ += seconds(0.05);
    if (scanning_) see();
    DwaInputs inputs;
    if (has_odometry_) inputs.odometry = Odometry{now_ - odometry_age_, robot_, twist_};
    inputs.odom_in_map = StampedPose2{now_ - transform_age_, {}};
    inputs.scan_stamp = scan_stamp_;
    inputs.emergency_stop = emergency_stop_;
    const DwaOutput output = dwa_.update(inputs, now_);
    twist_ = output.command;
    robot_ = vehicle::advance_along_arc(robot_, twist_.v * 0.05, twist_.omega * 0.05);
    return output;
  }
  DwaOutput run(double duration) {
    DwaOutput output;
    for (int i = 0; i < static_cast<int>(std::lround(duration / 0.05)); ++i) output = step();
    return output;
  }

  void see() {
    LaserScan scan;
    scan.stamp = now_;
    scan.range_min = 0.05F;
    scan.range_max = 6.0F;
    scan.angle_min = -0.3F;
    scan.angle_increment = 0.01F;
    for (int i = 0; i <= 60; ++i) {
      const double angle = scan.angle(static_cast<std::size_t>(i));
      const double distance = (wall_x_ - robot_.x - 0.62) / std::cos(angle);
      scan.ranges.push_back(static_cast<float>(distance));
    }
    dwa_.local_map().integrate(scan, {robot_, robot_, {0.62, 0, 0}});
    scan_stamp_ = now_;
  }

  static std::vector<Pose2> straight(double from, double to) {
    std::vector<Pose2> poses;
    const int steps = static_cast<int>(std::lround(std::abs(to - from) / 0.05));
    for (int i = 0; i <= steps; ++i) poses.push_back({from + (to - from) * i / steps, 0, 0});
    return poses;
  }

  Dwa dwa_;
  Pose2 robot_;
  Twist2 twist_;
  Time now_ = time_from_seconds(100.0);
  std::optional<Time> scan_stamp_;
  Duration odometry_age_{};
  Duration transform_age_{};
  bool has_odometry_ = true;
  bool scanning_ = true;
  bool emergency_stop_ = false;
  double wall_x_ = 100.0;  ///< m, a wall across the way
};

TEST_F(DwaTest, StandsIdleWithoutAPlan) {
  const DwaOutput output = run(0.5);
  EXPECT_EQ(output.state, DriveState::kIdle);
  EXPECT_EQ(output.command, (Twist2{}));
}

TEST_F(DwaTest, DrivesToTheGoalAndSaysSo) {
  dwa_.set_plan("1", straight(0, 2));
  EXPECT_EQ(run(0.5).state, DriveState::kDriving);
  const DwaOutput output = run(12.0);
  EXPECT_EQ(output.state, DriveState::kArrived);
  EXPECT_EQ(output.command, (Twist2{}));
  EXPECT_NEAR(robot_.x, 2.0, 0.03);
  EXPECT_NEAR(robot_.y, 0.0, 0.02);
}

TEST_F(DwaTest, DrivesBackwardsWhereThePlanDoes) {
  dwa_.set_plan("1", straight(0, -1));
  for (int i = 0; i < 400; ++i) {
    const DwaOutput output = step();
    EXPECT_LE(output.command.v, 0.0);
    EXPECT_GE(output.command.v, -0.3 - 1e-9);
    if (output.state == DriveState::kArrived) break;
  }
  EXPECT_NEAR(robot_.x, -1.0, 0.03);
}

TEST_F(DwaTest, StopsBeforeItChangesDirection) {
  std::vector<Pose2> poses = straight(0, 1);
  const std::vector<Pose2> back = straight(1, 0.5);
  poses.insert(poses.end(), back.begin() + 1, back.end());
  dwa_.set_plan("1", poses);
  double last = 0.0;
  bool reversed = false;
  for (int i = 0; i < 600; ++i) {
    const DwaOutput output = step();
    const bool turned = last * output.command.v < 0.0;
    if (turned) {
      EXPECT_LT(std::abs(last), 0.1);
    }
    reversed = reversed || output.command.v < 0.0;
    last = output.command.v;
    if (output.state == DriveState::kArrived) break;
  }
  EXPECT_TRUE(reversed);
  EXPECT_NEAR(robot_.x, 0.5, 0.03);
}

TEST_F(DwaTest, KeepsTheTurningRadiusInEveryCommand) {
  robot_ = {0.0, 0.3, 0.4};
  dwa_.set_plan("1", straight(0, 3));
  for (int i = 0; i < 200; ++i) {
    const Twist2 command = step().command;
    EXPECT_LE(std::abs(command.omega), std::abs(command.v) / 0.80 + 1e-3);
  }
}

TEST_F(DwaTest, StopsAtOnceOnAnEmergencyStopAndGoesOnWhenItIsReleased) {
  dwa_.set_plan("1", straight(0, 3));
  EXPECT_GT(run(1.0).command.v, 0.0);
  emergency_stop_ = true;
  DwaOutput output = step();
  EXPECT_EQ(output.command, (Twist2{}));
  EXPECT_EQ(output.reason, DriveReason::kEmergencyStop);
  run(60.0);
  emergency_stop_ = false;
  output = run(1.0);
  EXPECT_EQ(output.state, DriveState::kDriving);  // the pause does not count as being stuck
  EXPECT_GT(output.command.v, 0.0);
}

TEST_F(DwaTest, StopsWhenOdometryIsOld) {
  dwa_.set_plan("1", straight(0, 3));
  run(1.0);
  odometry_age_ = seconds(0.6);
  const DwaOutput output = step();
  EXPECT_EQ(output.command, (Twist2{}));
  EXPECT_EQ(output.reason, DriveReason::kNoPose);
}

TEST_F(DwaTest, StopsWhenNoOdometryHasCome) {
  has_odometry_ = false;
  dwa_.set_plan("1", straight(0, 3));
  const DwaOutput output = step();
  EXPECT_EQ(output.command, (Twist2{}));
  EXPECT_EQ(output.detail, "no odometry yet");
}

TEST_F(DwaTest, StopsWhenTheTransformIsOld) {
  dwa_.set_plan("1", straight(0, 3));
  run(1.0);
  transform_age_ = seconds(0.6);
  EXPECT_EQ(step().reason, DriveReason::kNoPose);
}

TEST_F(DwaTest, BrakesWithinThreeTenthsOfASecondOfTheLastScan) {
  dwa_.set_plan("1", straight(0, 3));
  run(1.0);
  scanning_ = false;
  EXPECT_GT(run(0.2).command.v, 0.0) << "two scans late are no reason";
  EXPECT_EQ(run(0.1).command, (Twist2{}));
}

TEST_F(DwaTest, BrakesAsSoonAsTheTransformIsOverdue) {
  dwa_.set_plan("1", straight(0, 3));
  run(1.0);
  transform_age_ = seconds(0.04);
  EXPECT_GT(step().command.v, 0.0);
  transform_age_ = seconds(0.06);
  EXPECT_EQ(step().reason, DriveReason::kNoPose);
}

TEST_F(DwaTest, StopsWhenTheScanIsOldAndGoesOnWithTheNextOne) {
  dwa_.set_plan("1", straight(0, 3));
  run(1.0);
  scanning_ = false;
  const DwaOutput output = run(0.7);
  EXPECT_EQ(output.command, (Twist2{}));
  EXPECT_EQ(output.reason, DriveReason::kSensorStale);
  scanning_ = true;
  EXPECT_GT(run(0.3).command.v, 0.0);
}

TEST_F(DwaTest, AnEmptyPlanStopsTheRobot) {
  dwa_.set_plan("1", straight(0, 3));
  run(1.0);
  dwa_.set_plan("1", {});
  const DwaOutput output = step();
  EXPECT_EQ(output.state, DriveState::kIdle);
  EXPECT_EQ(output.command, (Twist2{}));
}

TEST_F(DwaTest, DoesNotTouchAWallAcrossThePlanAndSaysThatItIsStuck) {
  wall_x_ = 2.0;
  dwa_.set_plan("1", straight(0, 3));
  bool asked = false;
  DwaOutput output;
  for (int i = 0; i < 2400 && output.state != DriveState::kFailed; ++i) {
    output = step();
    asked = asked || (output.state == DriveState::kDriving && output.reason == DriveReason::kStuck);
    EXPECT_LT(robot_.x + 0.77, 2.0);
  }
  EXPECT_TRUE(asked);
  EXPECT_EQ(output.state, DriveState::kFailed);
  EXPECT_EQ(output.reason, DriveReason::kStuck);
  EXPECT_EQ(output.command, (Twist2{}));
}

TEST_F(DwaTest, BacksUpAlongItsTrackWhenItStaysBlocked) {
  wall_x_ = 2.0;
  dwa_.set_plan("1", straight(0, 3));
  double farthest = 0.0;
  double back = 0.0;
  for (int i = 0; i < 600; ++i) {
    step();
    farthest = std::max(farthest, robot_.x);
    back = std::max(back, farthest - robot_.x);
  }
  EXPECT_GT(back, 0.3);
}

TEST_F(DwaTest, GoesOnWhenTheObstacleHasLeft) {
  wall_x_ = 2.0;
  dwa_.set_plan("1", straight(0, 3));
  run(6.0);
  EXPECT_LT(robot_.x, 1.25);
  wall_x_ = 100.0;
  run(20.0);
  EXPECT_NEAR(robot_.x, 3.0, 0.05);
}

TEST_F(DwaTest, ThePlanUnderANewNameGoesOnWhereItWas) {
  dwa_.set_plan("1", straight(0, 3));
  run(3.0);
  const double before = robot_.x;
  for (int i = 2; i < 40; ++i) {
    dwa_.set_plan(std::to_string(i), straight(0, 3));
    EXPECT_GE(step().command.v, 0.0);
  }
  EXPECT_GT(robot_.x, before + 0.2);
  EXPECT_EQ(dwa_.goal_id(), "39");
}

TEST_F(DwaTest, AsksForANewPlanWhereItEndsBesideTheGoal) {
  robot_ = {2.7, 0.5, 0.3};  // too near to get onto the line
  dwa_.set_plan("1", straight(2.6, 3));
  bool missed = false;
  for (int i = 0; i < 200; ++i) {
    const DwaOutput output = step();
    EXPECT_NE(output.state, DriveState::kArrived);
    missed = missed || output.reason == DriveReason::kMissedGoal;
  }
  EXPECT_TRUE(missed);
}

class PaperDwaTest : public DwaTest {
 protected:
  static DwaConfig paper() {
    DwaConfig config;
    config.mode = "paper";
    return config;
  }
  PaperDwaTest() : DwaTest(paper()) {}
};

TEST_F(PaperDwaTest, ScoresAreEquationTenAlone) {
  dwa_.set_plan("1", straight(0, 5));
  run(1.0);
  double sum = 0.0;
  for (const Candidate& candidate : dwa_.candidates()) {
    if (candidate.admissible) sum += candidate.score;
  }
  EXPECT_NEAR(sum, 0.05 + 0.10 + 0.10, 1e-9);  // each normalised term adds up to one
}

TEST_F(PaperDwaTest, DrivesForwardsAlongAStraightPlan) {
  dwa_.set_plan("1", straight(0, 3));
  run(5.0);
  EXPECT_GT(robot_.x, 1.0);
  EXPECT_NEAR(robot_.y, 0.0, 0.3);
}

}  // namespace
}  // namespace coop::dwa
