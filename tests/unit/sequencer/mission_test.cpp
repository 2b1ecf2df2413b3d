#include "sequencer/mission.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/random.hpp"
#include "unit/sequencer/mission_fixture.hpp"

namespace coop::sequencer {
namespace {

using test::MissionTest;

TEST_F(MissionTest, ASurveyDrivesItsWaypointsInOrderAndReportsTheOnesItMissed) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {1, 0, 0}}, {"pond", {2, 0, 0}}});
  step();
  ASSERT_EQ(goals_.size(), 1U);
  EXPECT_DOUBLE_EQ(goals_[0].pose_in_map.x, 1);
  arrive();
  step();
  step();
  ASSERT_EQ(goals_.size(), 2U);
  fail_to_arrive("no path");
  step_until_phase(MissionPhase::kDone);
  EXPECT_EQ(mission_.state().missed_waypoints, std::vector<std::string>{"pond: no path"});
  EXPECT_EQ(mission_.state().detail, "1 of 2 waypoints reached");
}

TEST_F(MissionTest, AWaypointInPassingNeedsNoArrival) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {3, 0, 0}}, {"pond", {9, 0, 0}}});
  step();
  robot_ = Pose2{2.5, 0.2, 1.0};
  step();
  step();
  EXPECT_DOUBLE_EQ(goals_.back().pose_in_map.x, 9);
  robot_ = Pose2{8.9, 0, 0};
  step();
  EXPECT_TRUE(mission_.state().is_active()) << "the last one is driven to its end";
}

TEST_F(MissionTest, TooFewEggsAreSearchedForOnceMoreTheOtherWayRound) {
  mission_.start(MissionKind::kCollect, "m", {{"gate", {1, 0, 0}}, {"pond", {5, 0, 0}}});
  for (int i = 0; i < 2; ++i) {
    step();
    arrive();
    step();
  }
  for (int i = 0; i < 5; ++i) step();
  EXPECT_EQ(mission_.state().searches, 1);
  EXPECT_EQ(mission_.state().waypoints.front().name, "pond");
  arrive();
  step_until_phase(MissionPhase::kDone, 20);
  EXPECT_EQ(mission_.state().searches, 2);
}

TEST_F(MissionTest, TwoEggsAreSearchedOrderedDrivenToAndPicked) {
  mission_.start(MissionKind::kCollect, "m", {{"gate", {1, 0, 0}}});
  step();
  add_egg("egg1", 3, 0);
  add_egg("egg2", 5, 0);
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "egg1");
  for (const char* egg : {"egg1", "egg2"}) {
    drive_and_pick();
    ASSERT_EQ(picks_.back().egg_id, egg);
    answer_pick(true);
    step();
  }
  step_until_phase(MissionPhase::kDone);
  EXPECT_EQ(mission_.state().detail, "2 of 2 eggs picked");
  EXPECT_EQ(mission_.state().order, (std::vector<std::string>{"egg1", "egg2"}));
}

TEST_F(MissionTest, TheGoalOfAnEggIsItsApproachPose) {
  mission_.start(MissionKind::kCollect, "m", {});
  add_egg("egg1", 3, 0);
  add_egg("egg2", 9, 0);
  step_until_phase(MissionPhase::kDriving);
  step();
  EXPECT_NEAR(goals_.back().pose_in_map.x, 3 - 0.92, 1e-12);
}

TEST_F(MissionTest, AGoalIsToldAgainUntilItIsAnswered) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {1, 0, 0}}});
  step();
  for (int i = 0; i < 50; ++i) step();
  EXPECT_GE(goals_.size(), 3U);
  for (const GoalOrder& goal : goals_) EXPECT_EQ(goal.goal_id, goals_.front().goal_id);
}

TEST_F(MissionTest, AnAnswerToAnotherGoalIsNotAnAnswer) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {1, 0, 0}}});
  step();
  navigation_ = {"17", NavigationReport::State::kArrived, ""};
  step();
  EXPECT_EQ(mission_.state().next_waypoint, 0U);
}

TEST_F(MissionTest, AnEggThatCannotBeReachedIsTriedFromAnotherSideAndThenReported) {
  approach_an_egg();
  const double first = goals_.back().pose_in_map.yaw;
  fail_to_arrive("no path");
  step_until_phase(MissionPhase::kOrdering);
  step_until_phase(MissionPhase::kDriving);
  step();
  EXPECT_GT(std::abs(angle_difference(goals_.back().pose_in_map.yaw, first)), 0.3);
  fail_to_arrive("stuck");
  step_until_phase(MissionPhase::kDone);
  EXPECT_EQ(mission_.state().eggs[0].phase, EggPhase::kFailed);
  EXPECT_EQ(mission_.state().eggs[0].reason, "stuck");
}

TEST_F(MissionTest, SidesThatAreRefusedBeforeTheRobotMovesUseUpNoAttempt) {
  approach_an_egg();
  std::vector<double> headings;
  for (int side = 0; side < 5; ++side) {
    for (const double heading : headings) {
      EXPECT_GT(std::abs(angle_difference(goals_.back().pose_in_map.yaw, heading)), 0.3);
    }
    headings.push_back(goals_.back().pose_in_map.yaw);
    EXPECT_EQ(egg().attempts, 1) << "side " << side;
    EXPECT_EQ(egg().phase, EggPhase::kApproaching);
    refuse("no path");
    step();
    step();
  }
  // The fifth refusal is one too many.
  EXPECT_EQ(egg().reason, "no path");
  step_until_phase(MissionPhase::kDriving);
  step();
  EXPECT_EQ(egg().attempts, 2);
}

TEST_F(MissionTest, AnEggOutOfReachOnArrivalIsApproachedAgain) {
  approach_an_egg();
  arrive();
  robot_ = Pose2{2.3, 0, 0};  // the egg lies 0.70 m ahead
  for (int i = 0; i < 10 && mission_.state().eggs[0].reason.empty(); ++i) step();
  EXPECT_NE(mission_.state().eggs[0].reason.find("out of reach"), std::string::npos);
  EXPECT_EQ(mission_.state().eggs[0].attempts, 1);
}

TEST_F(MissionTest, APickIsToldAgainUnderItsIdWhileTheArmIsSilentOrBusy) {
  approach_an_egg();
  arrive_and_pick();
  pick_ = PickReport{mission_.state().pick_id, false, false, "busy"};
  for (int i = 0; i < 100; ++i) step();
  ASSERT_GE(picks_.size(), 3U);
  std::set<std::string> ids;
  for (const PickOrder& pick : picks_) ids.insert(pick.pick_id);
  EXPECT_EQ(ids.size(), 1U);
}

TEST_F(MissionTest, AnEggSeenOnTheWayIsCollectedToo) {
  mission_.start(MissionKind::kCollect, "m", {});
  add_egg("egg1", 3, 0);
  step_until_phase(MissionPhase::kDriving);
  add_egg("egg2", 6, 0);
  for (int i = 0; i < 2; ++i) {
    drive_and_pick();
    answer_pick(true);
    step();
  }
  step_until_phase(MissionPhase::kDone);
  EXPECT_EQ(mission_.state().count(EggPhase::kPicked), 2);
}

TEST_F(MissionTest, PauseTakesTheGoalBackAndResumeGivesANewOne) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {5, 0, 0}}});
  step();
  const std::string id = goals_.back().goal_id;
  mission_.pause();
  step();
  EXPECT_EQ(taken_back_, std::vector<std::string>{id});
  EXPECT_EQ(goals_.size(), 1U);
  mission_.resume();
  step();
  EXPECT_DOUBLE_EQ(goals_.back().pose_in_map.x, 5);
  EXPECT_NE(goals_.back().goal_id, id);
}

TEST_F(MissionTest, AGoalIsTakenBackUntilANavigatorAnswers) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {5, 0, 0}}});
  step();
  mission_.abort("enough");
  for (int i = 0; i < 50; ++i) step();  // 5 s
  EXPECT_EQ(taken_back_.size(), 3U);
  fail_to_arrive("cancelled");
  for (int i = 0; i < 50; ++i) step();
  EXPECT_EQ(taken_back_.size(), 3U);
  EXPECT_EQ(mission_.state().phase, MissionPhase::kFailed);
}

TEST_F(MissionTest, AMissionRestoredWhilePausedTakesItsGoalBack) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {5, 0, 0}}});
  step();
  mission_.pause();
  const MissionState saved = mission_.state();
  mission_ = Mission(config(), {});
  mission_.restore(saved);
  step();
  EXPECT_EQ(taken_back_, std::vector<std::string>{goals_.back().goal_id});
}

TEST_F(MissionTest, AtItsEndNoGoalIsInForce) {
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {5, 0, 0}}});
  step();
  arrive();
  step_until_phase(MissionPhase::kDone);
  for (int i = 0; i < 30; ++i) step();
  EXPECT_TRUE(taken_back_.empty());
}

TEST_F(MissionTest, WithoutAPoseNothingIsOrdered) {
  robot_.reset();
  mission_.start(MissionKind::kSurvey, "m", {{"gate", {5, 0, 0}}});
  step();
  EXPECT_TRUE(goals_.empty());
}

TEST_F(MissionTest, WhateverIsAnsweredNoEggIsLostOrPickedTwice) {
  int missing = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomStream random(seed, "answers");
    mission_ = Mission(config(), {});
    tracks_.clear();
    goals_.clear();
    picks_.clear();
    pick_.reset();
    std::map<std::string, int> picked;
    mission_.start(MissionKind::kCollect, "m", {{"gate", {1, 0, 0}}});
    for (int i = 0; i < 2000 && mission_.state().is_active(); ++i) {
      if (random.uniform() < 0.01 && tracks_.size() < 6) {
        add_egg("egg" + std::to_string(tracks_.size() + 1), random.uniform(2, 9), 1);
      }
      if (random.uniform() < 0.02) {  // the process dies and comes back from its journal
        const MissionState saved = mission_.state();
        mission_ = Mission(config(), {});
        mission_.restore(saved);
      }
      if (!goals_.empty() && random.uniform() < 0.3) {
        if (random.uniform() < 0.7) {
          arrive();
        } else {
          fail_to_arrive("chance");
        }
      }
      if (!mission_.state().pick_id.empty() && random.uniform() < 0.3) {
        answer_pick(random.uniform() < 0.6, "chance");
      }
      for (EggTrack& track : tracks_) {  // now and then a picture, with the egg or without it
        const bool shown = random.uniform() < 0.9;
        const bool with = random.uniform() < 0.1;
        if (!shown) continue;
        track.seen_in_row = with ? track.seen_in_row + 1 : 0;
        track.unseen_in_row = with ? 0 : track.unseen_in_row + 1;
      }
      for (const std::string& id : step(0.3).picked_eggs) ++picked[id];
    }
    ASSERT_FALSE(mission_.state().is_active()) << "seed " << seed;
    for (const EggTask& egg : mission_.state().eggs) {
      const bool was_picked = egg.phase == EggPhase::kPicked;
      const bool was_missing = egg.phase == EggPhase::kMissing;
      missing += was_missing ? 1 : 0;
      EXPECT_TRUE(was_picked || was_missing || egg.phase == EggPhase::kFailed) << "seed " << seed;
      EXPECT_EQ(picked[egg.id], was_picked ? 1 : 0) << "seed " << seed;
      EXPECT_EQ(egg.reason.empty(), was_picked) << "seed " << seed;
    }
  }
  EXPECT_GT(missing, 5) << "the case occurs";
}

}  // namespace
}  // namespace coop::sequencer
