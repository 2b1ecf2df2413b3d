#include <gtest/gtest.h>

#include "unit/sequencer/mission_fixture.hpp"

namespace coop::sequencer {
namespace {

/// Six pictures without the egg are enough, two looks, four approaches.
class MissionEggsTest : public test::MissionTest {
 protected:
  static MissionConfig config() {
    MissionConfig config;
    config.unseen_after = 6;
    config.max_looks = 2;
    config.max_attempts = 4;
    return config;
  }
  MissionEggsTest() { mission_ = Mission(config(), {}); }

  /// The robot comes near the approach pose and the camera shows that there is no egg.
  void look_in_vain(const std::string& id) {
    step_until_phase(MissionPhase::kDriving);
    step();
    stand_before_goal(0.3);
    show(id, false, 7);
  }
};

TEST_F(MissionEggsTest, AnEggNotSeenIsLookedForFromAnotherSideAndThenReportedMissing) {
  approach_an_egg();
  const double first = goals_.back().pose_in_map.yaw;
  look_in_vain("egg1");
  EXPECT_EQ(egg().phase, EggPhase::kQueued);
  EXPECT_EQ(egg().unseen, 1);
  step_until_phase(MissionPhase::kDriving);
  step();
  EXPECT_GE(std::abs(angle_difference(goals_.back().pose_in_map.yaw, first)), 1.0);
  look_in_vain("egg1");
  EXPECT_EQ(egg().phase, EggPhase::kMissing);
  EXPECT_EQ(egg().reason, "not there: 6 pictures of its place without it");
  step_until_phase(MissionPhase::kDone);
  EXPECT_TRUE(picks_.empty());
  EXPECT_EQ(mission_.state().detail, "0 of 1 eggs picked, 1 missing");
}

TEST_F(MissionEggsTest, PicturesFromFarOffTheApproachPoseDoNotCount) {
  approach_an_egg();
  stand_before_goal(0.7);  // more than look_from
  show("egg1", false, 30);
  EXPECT_EQ(egg().phase, EggPhase::kApproaching);
  stand_before_goal(0.5);
  show("egg1", false, 5);
  EXPECT_EQ(egg().unseen, 0) << "five since it is near, six are needed";
  show("egg1", false, 2);
  EXPECT_EQ(egg().unseen, 1);
}

TEST_F(MissionEggsTest, OneSightOfTheEggIsEnoughToGoOn) {
  approach_an_egg();
  stand_before_goal(0.3);
  for (int i = 0; i < 5; ++i) {
    show("egg1", false, 5);
    show("egg1", true);
  }
  arrive();
  step_until_phase(MissionPhase::kPicking);
  EXPECT_EQ(egg().unseen, 0);
}

TEST_F(MissionEggsTest, OnArrivalTheMissionWaitsForThePicturesToAgree) {
  approach_an_egg();
  stand_before_goal(0.3);
  show("egg1", false, 2);
  arrive();
  for (int i = 0; i < 10; ++i) step();  // 1 s, longer than the settling
  EXPECT_EQ(mission_.state().phase, MissionPhase::kDriving);
  show("egg1", true);
  step();
  EXPECT_EQ(mission_.state().phase, MissionPhase::kPicking);
}

TEST_F(MissionEggsTest, OnArrivalWithTooFewPicturesTheArmIsToTry) {
  approach_an_egg();
  stand_before_goal(0.3);
  show("egg1", false, 2);
  arrive();
  for (int i = 0; i < 25; ++i) step();  // 2.5 s, longer than look_time
  EXPECT_EQ(mission_.state().phase, MissionPhase::kPicking);
}

TEST_F(MissionEggsTest, WithoutACameraTheArmIsToTryAtOnce) {
  approach_an_egg();
  arrive();
  for (int i = 0; i < 8; ++i) step();
  EXPECT_EQ(mission_.state().phase, MissionPhase::kPicking);
}

TEST_F(MissionEggsTest, EggsNotSeenAreLookedForAgainAfterTheOthers) {
  approach_an_egg();
  add_egg("egg2", 6, 0);
  look_in_vain("egg1");
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "egg2");
}

TEST_F(MissionEggsTest, AMissingEggThatIsSeenAgainIsATargetAgain) {
  approach_an_egg();
  add_egg("egg2", 6, 0);
  look_in_vain("egg1");
  step_until_phase(MissionPhase::kDriving);
  step();
  arrive();
  step_until_phase(MissionPhase::kPicking);
  answer_pick(true);
  step();
  look_in_vain("egg1");
  ASSERT_EQ(egg().phase, EggPhase::kMissing);
  show("egg1", true, 2);
  EXPECT_EQ(egg().phase, EggPhase::kMissing) << "two pictures may be a flicker";
  show("egg1", true, 1);
  EXPECT_EQ(egg().phase, EggPhase::kQueued);
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "egg1");
}

TEST_F(MissionEggsTest, WhatIsSeenOnlyFromAfarDoesNotHoldTheMissionForEver) {
  MissionConfig searching = config();
  searching.expected_eggs = 1;
  searching.max_searches = 5;
  mission_ = Mission(searching, {});
  mission_.start(MissionKind::kCollect, "m", {{"gate", {9, 0, 0}}});
  add_egg("egg1", 3, 0);
  for (int look = 0; look < 4; ++look) {
    ASSERT_TRUE(mission_.state().is_active());
    look_in_vain("egg1");
    if (egg().phase == EggPhase::kMissing) show("egg1", true, 3);
  }
  EXPECT_EQ(egg().attempts, 4);
  for (int i = 0; i < 100 && mission_.state().is_active(); ++i) {
    step();
    arrive();
  }
  EXPECT_EQ(mission_.state().phase, MissionPhase::kDone);
  EXPECT_EQ(egg().phase, EggPhase::kMissing);
}

TEST_F(MissionEggsTest, AGoalGivenUpIsTakenBackWhereNothingIsLeftToDo) {
  approach_an_egg();
  look_in_vain("egg1");
  look_in_vain("egg1");
  step_until_phase(MissionPhase::kDone);
  EXPECT_EQ(taken_back_, std::vector<std::string>{goals_.back().goal_id});
}

TEST_F(MissionEggsTest, WhatTheArmLostIsCollectedBeforeTheMissionEnds) {
  approach_an_egg();
  arrive();
  step_until_phase(MissionPhase::kPicking);
  step();
  answer_pick(true);
  for (int i = 0; i < 10; ++i) step();  // 1 s of last_look
  EXPECT_TRUE(mission_.state().is_active());
  add_egg("egg2", 3, 0);  // what the tracks make of an egg in a picked one's place
  step_until_phase(MissionPhase::kDriving);
  EXPECT_EQ(mission_.state().current_egg, "egg2");
}

TEST_F(MissionEggsTest, AMissingEggIsNotAKnownOne) {
  MissionConfig searching = config();
  searching.expected_eggs = 1;
  mission_ = Mission(searching, {});
  mission_.start(MissionKind::kCollect, "m", {{"gate", {9, 0, 0}}});
  add_egg("egg1", 3, 0);
  look_in_vain("egg1");
  look_in_vain("egg1");
  ASSERT_EQ(egg().phase, EggPhase::kMissing);
  step_until_phase(MissionPhase::kSearching);
  EXPECT_EQ(mission_.state().detail, "0 of 1 eggs known, search 2");
}

}  // namespace
}  // namespace coop::sequencer
