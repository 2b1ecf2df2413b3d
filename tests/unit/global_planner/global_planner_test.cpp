#include "global_planner/global_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/global_planner/drawn_map.hpp"

namespace coop::global_planner {
namespace {

using test::draw_room;
using test::kRobotFootprint;
using test::kTurningRadius;

const Pose2 kStart{1.2, 2.5, 0.0};
const Pose2 kGoal{4.0, 2.5, 0.0};

/// A planner with a room, called ten times a second.
class GlobalPlannerTest : public testing::Test {
 protected:
  void SetUp() override { planner_.map().set_map(draw_room()); }

  /// Updates until `duration` seconds have passed; what changed in that time.
  GlobalPlanner::Changes run(double duration, const std::optional<Pose2>& robot) {
    GlobalPlanner::Changes all;
    plans_ = 0;
    for (double t = 0.0; t < duration - 1e-9; t += 0.1) {
      const auto changes = planner_.update(robot, now_);
      all.plan = all.plan || changes.plan;
      all.status = all.status || changes.status;
      all.costmap = all.costmap || changes.costmap;
      plans_ += changes.plan ? 1 : 0;
      now_ += seconds(0.1);
    }
    return all;
  }
  void set_goal(const std::string& id, const Pose2& pose) { planner_.set_goal({id, pose}, now_); }

  /// Goal "1" and the plan to it.
  void plan_to_goal() {
    set_goal("1", kGoal);
    run(0.5, kStart);
  }
  static DriverReport arrival(const std::string& goal_id) {
    DriverReport report;
    report.goal_id = goal_id;
    report.arrived = true;
    return report;
  }

  /// A thing of 0.3 m in the way, as the laser sees it.
  void show_obstacle(const Pose2& robot, double range) {
    LaserScan scan;
    scan.stamp = now_;
    scan.range_min = 0.1F;
    scan.range_max = 10.0F;
    scan.angle_min = -0.15F;
    scan.angle_increment = 0.01F;
    scan.ranges.assign(31, static_cast<float>(range));
    planner_.map().integrate(scan, {robot, robot, {}});
  }

  GlobalPlanner planner_{{}, kRobotFootprint, kTurningRadius, RandomStream(1, "planner")};
  Time now_ = time_from_seconds(100.0);
  int plans_ = 0;
};

TEST_F(GlobalPlannerTest, IsIdleWithoutAGoal) {
  run(2.0, kStart);
  EXPECT_EQ(planner_.status().state, PlannerState::kIdle);
  EXPECT_TRUE(planner_.plan().empty());
}

TEST_F(GlobalPlannerTest, PlansAtOnceAndThenKeepsThePlan) {
  set_goal("1", kGoal);
  EXPECT_TRUE(run(0.1, kStart).plan);
  EXPECT_EQ(planner_.status().state, PlannerState::kPlanned);
  EXPECT_EQ(planner_.status().goal_id, "1");
  EXPECT_FALSE(run(10.0, kStart).plan);
}

TEST_F(GlobalPlannerTest, SaysWhatItWaitsForAndGivesUpAfterItsPatience) {
  set_goal("1", kGoal);
  run(1.0, std::nullopt);
  EXPECT_EQ(planner_.status().state, PlannerState::kPlanning);
  EXPECT_EQ(planner_.status().reason, PlannerReason::kNoPose);
  run(11.0, std::nullopt);
  EXPECT_EQ(planner_.status().state, PlannerState::kFailed);
  EXPECT_EQ(planner_.status().reason, PlannerReason::kNoPose);
}

TEST_F(GlobalPlannerTest, GoesOnWhenThePoseComesInTime) {
  set_goal("1", kGoal);
  run(3.0, std::nullopt);
  EXPECT_TRUE(run(1.0, kStart).plan);
  EXPECT_EQ(planner_.status().state, PlannerState::kPlanned);
}

TEST_F(GlobalPlannerTest, SaysThatThereIsNoMap) {
  GlobalPlanner blind({}, kRobotFootprint, kTurningRadius, RandomStream(1, "planner"));
  blind.set_goal({"1", kGoal}, now_);
  blind.update(kStart, now_);
  EXPECT_EQ(blind.status().reason, PlannerReason::kNoMap);
}

TEST_F(GlobalPlannerTest, FailsAGoalInTheWallAtOnceAndOffersAnother) {
  set_goal("1", {5.2, 2.5, 0.0});
  run(0.1, kStart);
  EXPECT_EQ(planner_.status().state, PlannerState::kFailed);
  EXPECT_EQ(planner_.status().reason, PlannerReason::kGoalBlocked);
  EXPECT_TRUE(planner_.status().alternative);
}

TEST_F(GlobalPlannerTest, AGoalThatMovesALittleKeepsThePlanUnderItsNewName) {
  plan_to_goal();
  const auto poses = planner_.plan();
  set_goal("2", {kGoal.x + 0.02, kGoal.y, 0.01});
  EXPECT_TRUE(run(0.1, kStart).plan);
  EXPECT_EQ(planner_.plan(), poses);
  EXPECT_EQ(planner_.status().goal_id, "2");
}

TEST_F(GlobalPlannerTest, AGoalThatMovesFarIsPlannedAnew) {
  plan_to_goal();
  set_goal("2", {4.0, 3.5, 0.0});
  EXPECT_TRUE(run(0.1, kStart).plan);
  EXPECT_EQ(planner_.plan().back(), (Pose2{4.0, 3.5, 0.0}));
}

TEST_F(GlobalPlannerTest, ASmallMoveOfTheGoalMattersMoreTheNearerTheRobot) {
  plan_to_goal();
  set_goal("2", {kGoal.x + 0.08, kGoal.y, 0.0});
  run(0.5, kStart);
  EXPECT_EQ(planner_.plan().back(), kGoal);  // 2.8 m away: 0.03 m + 0.05 * 2.8 m is allowed
  for (double x = kStart.x; x < 3.8; x += 0.1) run(0.5, Pose2{x, 2.5, 0.0});
  EXPECT_NEAR(planner_.plan().back().x, kGoal.x + 0.08, 1e-9);
}

TEST_F(GlobalPlannerTest, ARobotThatStraysGetsANewPlan) {
  plan_to_goal();
  EXPECT_TRUE(run(0.6, Pose2{1.6, 3.2, 0.3}).plan);
}

TEST_F(GlobalPlannerTest, PlansAroundAnObstacleThatAppears) {
  plan_to_goal();
  show_obstacle(kStart, 1.6);
  EXPECT_TRUE(run(0.6, kStart).plan);
  double farthest = 0.0;
  for (const Pose2& pose : planner_.plan()) farthest = std::max(farthest, std::abs(pose.y - 2.5));
  EXPECT_GT(farthest, 0.3);
}

TEST_F(GlobalPlannerTest, TheDriverMayAskForANewPlanOnce) {
  plan_to_goal();
  DriverReport report;
  report.goal_id = "1";
  report.wants_new_plan = true;
  for (int i = 0; i < 20; ++i) planner_.report(report);
  run(2.0, kStart);
  EXPECT_EQ(plans_, 1);
}

TEST_F(GlobalPlannerTest, ForgetsTheGoalWhenTheDriverHasArrived) {
  plan_to_goal();
  planner_.report(arrival("1"));
  run(0.5, kGoal);
  EXPECT_EQ(planner_.status().state, PlannerState::kIdle);
  set_goal("1", kGoal);
  EXPECT_FALSE(run(1.0, kGoal).plan);  // told again: the same goal, already reached
}

TEST_F(GlobalPlannerTest, IgnoresReportsAboutAnotherGoal) {
  set_goal("2", kGoal);
  run(0.5, kStart);
  planner_.report(arrival("1"));
  EXPECT_EQ(planner_.status().state, PlannerState::kPlanned);
}

TEST_F(GlobalPlannerTest, AGoalTakenBackLeavesAnEmptyPlanAndIsNotTakenUpWhenToldAgain) {
  plan_to_goal();
  EXPECT_TRUE(planner_.cancel("1"));
  const auto changes = run(0.1, kStart);
  EXPECT_TRUE(changes.plan);
  EXPECT_TRUE(changes.status);
  EXPECT_TRUE(planner_.plan().empty());
  EXPECT_EQ(planner_.status().state, PlannerState::kCancelled);
  EXPECT_EQ(planner_.status().goal_id, "1");
  plan_to_goal();
  EXPECT_TRUE(planner_.plan().empty());
}

TEST_F(GlobalPlannerTest, WhoTakesAnotherGoalBackLeavesThisOneInForce) {
  plan_to_goal();
  EXPECT_FALSE(planner_.cancel("another"));
  EXPECT_FALSE(run(0.5, kStart).plan);
  EXPECT_EQ(planner_.status().state, PlannerState::kPlanned);
}

TEST_F(GlobalPlannerTest, WithoutANameTheGoalInForceIsTakenBack) {
  plan_to_goal();
  EXPECT_TRUE(planner_.cancel(""));
  EXPECT_TRUE(run(0.1, kStart).plan);
  EXPECT_EQ(planner_.status().goal_id, "1");
}

TEST_F(GlobalPlannerTest, AGoalOfBeforeItsStartIsTakenBackFromTheDriver) {
  EXPECT_TRUE(planner_.cancel("1"));
  const auto changes = run(0.1, kStart);
  EXPECT_TRUE(changes.plan);
  EXPECT_TRUE(planner_.plan().empty());
  EXPECT_EQ(planner_.status().state, PlannerState::kCancelled);
  EXPECT_EQ(planner_.status().goal_id, "1");
}

TEST_F(GlobalPlannerTest, DoesNotFlipBetweenWaysWhileTheRobotFollowsItsPlan) {
  set_goal("1", {4.0, 3.5, 1.57});
  run(0.1, kStart);
  const std::vector<Pose2> poses = planner_.plan();
  int changes = 0;
  for (const Pose2& pose : poses) {
    run(0.1, pose);
    changes += plans_;
  }
  EXPECT_LE(changes, 1);
}

}  // namespace
}  // namespace coop::global_planner
