// The cleaning of a pen: heaps are driven over, whatever the robot was on its way to.
#include <gmock/gmock.h>

#include "unit/sequencer/mission_fixture.hpp"

namespace coop::sequencer::test {
namespace {

const Eigen::AlignedBox2d kBlade(Eigen::Vector2d(0.38, -0.21), Eigen::Vector2d(0.44, 0.21));
constexpr double kDistance = 0.36;  ///< of base_link from a heap at the end of a drive, m

class CleanTest : public MissionTest {
 protected:
  CleanTest() {
    MissionConfig settings = config();
    settings.max_attempts = 3;
    settings.return_home = true;
    ApproachConfig approach;
    approach.distance = kDistance;
    mission_ = Mission(settings, approach, kBlade);
  }

  void start() {
    mission_.start(MissionKind::kClean, "clean-1", {});
    pictures_ = 0;
    step();
    pictures_ = 10;
    step();
  }
  /// Straight on from where the robot stands to the last goal, in steps as the shell makes them.
  void drive_to_goal() {
    const Pose2 goal = goals_.back().pose_in_map;
    const Pose2 from{goal.x - std::cos(goal.yaw), goal.y - std::sin(goal.yaw), goal.yaw};
    const std::size_t goals = goals_.size();
    for (int i = 0; i <= 20 && goals_.size() == goals; ++i) {
      robot_ = from * Pose2{0.05 * i, 0, 0};
      step();
    }
    if (goals_.size() == goals) arrive();
  }
};

TEST_F(CleanTest, ThePenIsLookedAtBeforeTheOrderIsMade) {
  mission_.start(MissionKind::kClean, "clean-1", {});
  for (int i = 0; i < 50; ++i) step();
  EXPECT_EQ(mission_.state().phase, MissionPhase::kSearching) << "no picture has come";
  pictures_ = 10;
  add_egg("heap1", 3, 0);
  step();
  EXPECT_EQ(mission_.state().phase, MissionPhase::kOrdering);
}

TEST_F(CleanTest, AHeapIsCleanedWhenTheBladeHasPassedOverItAndTheRobotGoesHome) {
  add_egg("heap1", 3, 0);
  start();
  step_until_phase(MissionPhase::kDriving);
  step();
  EXPECT_NEAR(goals_.back().pose_in_map.x, 3 - kDistance, 1e-9);
  drive_to_goal();
  step();
  EXPECT_EQ(egg().phase, EggPhase::kPicked);
  EXPECT_TRUE(picks_.empty()) << "no arm is asked";
  step_until_phase(MissionPhase::kReturning);
  step();
  arrive();
  for (int i = 0; i < 40; ++i) step();
  EXPECT_EQ(mission_.state().phase, MissionPhase::kDone);
  EXPECT_EQ(mission_.state().detail, "1 of 1 heaps cleaned");
}

TEST_F(CleanTest, AHeapOnTheWayToAnotherIsCleanedInPassing) {
  add_egg("heap1", 3, 0);
  add_egg("heap2", 2.5, 0.05);
  start();
  step_until_phase(MissionPhase::kDriving);
  step();
  ASSERT_EQ(mission_.state().current_egg, "heap1");
  drive_to_goal();
  step();
  EXPECT_EQ(mission_.state().count(EggPhase::kPicked), 2);
  EXPECT_EQ(mission_.state().find_egg("heap2")->attempts, 0);
}

TEST_F(CleanTest, AHeapThatTheBladeMissesIsTriedAgainAndThenReported) {
  add_egg("heap1", 3, 0);
  start();
  for (int attempt = 1; attempt <= 3; ++attempt) {
    if (attempt == 3) {  // the last one from home, out of the way of whoever hid the heap
      step_until_phase(MissionPhase::kReturning);
      step();
      arrive();
    }
    step_until_phase(MissionPhase::kDriving);
    step();
    EXPECT_EQ(egg().attempts, attempt);
    // Past it on the left.
    robot_ = goals_.back().pose_in_map * Pose2{-0.3, 0.3, 0};
    step();
    robot_ = goals_.back().pose_in_map * Pose2{0, 0.3, 0};
    navigation_ = {goals_.back().goal_id, NavigationReport::State::kArrived, ""};
    for (int i = 0; i < 8; ++i) step();
    EXPECT_THAT(egg().reason, testing::HasSubstr("the blade missed it"));
  }
  EXPECT_EQ(egg().phase, EggPhase::kFailed);
  step_until_phase(MissionPhase::kReturning);
}

TEST_F(CleanTest, WhatFailedIsPutOffAndTriedAgainAfterAPause) {
  add_egg("heap1", 3, 0);
  add_egg("heap2", 0, 3);
  start();
  step_until_phase(MissionPhase::kDriving);
  step();
  robot_ = {1, 0, 0};  // under way, so that it is no refusal
  navigation_ = {goals_.back().goal_id, NavigationReport::State::kFailed, "a pig lies there"};
  step();
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "heap2") << "the other one first";
  step();
  drive_to_goal();
  const std::size_t goals = goals_.size();
  for (int i = 0; i < 45; ++i) step();
  EXPECT_EQ(goals_.size(), goals) << "the pig is given time";
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "heap1");
}

TEST_F(CleanTest, AHeapSeenFromHomeIsCleanedBeforeTheMissionEnds) {
  add_egg("heap1", 3, 0);
  start();
  step_until_phase(MissionPhase::kDriving);
  step();
  drive_to_goal();
  step_until_phase(MissionPhase::kReturning);
  step();
  arrive();
  step();
  add_egg("heap2", 2, 1);
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "heap2");
}

/// What the robot hides of a heap from the camera shifts the place of the rest.
TEST_F(CleanTest, AHeapWhosePlaceShiftsBackUnderTheBladeIsCleanedAllTheSame) {
  add_egg("heap1", 3, 0);
  start();
  robot_ = Pose2{2.45, 0, 0};
  step();
  robot_ = Pose2{2.58, 0, 0};
  step();
  ASSERT_NE(egg().phase, EggPhase::kPicked);
  tracks_[0].egg_in_map = {2.95, 0};
  robot_ = Pose2{2.60, 0, 0};
  step();
  EXPECT_EQ(egg().phase, EggPhase::kPicked);
}

TEST_F(CleanTest, BackwardsNothingIsCleaned) {
  add_egg("heap1", 3, 0);
  robot_ = Pose2{2.8, 0, 0};
  start();
  for (int i = 0; i < 30; ++i) {
    robot_ = Pose2{2.8 - 0.05 * i, 0, 0};
    step();
  }
  EXPECT_NE(egg().phase, EggPhase::kPicked);
}

}  // namespace
}  // namespace coop::sequencer::test
