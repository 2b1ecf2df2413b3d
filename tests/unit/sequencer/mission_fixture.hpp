#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sequencer/mission.hpp"

namespace coop::sequencer::test {

/// A world that answers the mission: it drives at once, picks at once, unless told to fail.
class MissionTest : public ::testing::Test {
 protected:
  MissionTest() : mission_(config(), {}) {
    queries_.pose_cost = [](const Pose2&) { return std::optional<double>(1.0); };
    queries_.order = [](const Pose2&, const std::vector<const EggTask*>& eggs) {
      OrderedEggs ordered;
      for (const EggTask* egg : eggs) ordered.order.push_back(egg->id);
      ordered.cost = 5.0;
      return ordered;
    };
  }

  static MissionConfig config() {
    MissionConfig config;
    config.max_attempts = 2;
    config.expected_eggs = 2;
    return config;
  }

  /// The camera shows the place of the egg, with it or without it, and a step is done.
  void show(const std::string& id, bool with_egg, int pictures = 1) {
    for (int i = 0; i < pictures; ++i) {
      EggTrack& track = *std::ranges::find(tracks_, id, &EggTrack::id);
      track.seen_in_row = with_egg ? track.seen_in_row + 1 : 0;
      track.unseen_in_row = with_egg ? 0 : track.unseen_in_row + 1;
      step(0.2);
    }
  }
  /// Under way to the only egg, at (3, 0).
  void approach_an_egg() {
    mission_.start(MissionKind::kCollect, "m", {});
    add_egg("egg1", 3, 0);
    step_until_phase(MissionPhase::kDriving);
    step();
  }
  /// From the goal set to the order of its pick.
  void arrive_and_pick() {
    arrive();
    step_until_phase(MissionPhase::kPicking);
    step();
  }
  /// From the order of the eggs to the order of a pick.
  void drive_and_pick() {
    step_until_phase(MissionPhase::kDriving);
    step();
    arrive_and_pick();
  }
  /// From the goal: the robot stands there, or so far behind it.
  void stand_before_goal(double metres) {
    robot_ = goals_.back().pose_in_map * Pose2{-metres, 0, 0};
  }
  [[nodiscard]] const EggTask& egg(std::size_t index = 0) const {
    return mission_.state().eggs.at(index);
  }

  void add_egg(const std::string& id, double x, double y) {
    EggTrack track;
    track.id = id;
    track.egg_in_map = {x, y};
    track.confirmed = true;
    tracks_.push_back(track);
  }

  MissionActions step(double dt = 0.1) {
    now_ += seconds(dt);
    MissionSnapshot snapshot;
    snapshot.robot_in_map = robot_;
    snapshot.navigation = navigation_;
    snapshot.pick = pick_;
    snapshot.tracks = &tracks_;
    snapshot.pictures = pictures_;
    const MissionActions actions = mission_.step(snapshot, queries_, now_);
    if (actions.goal) goals_.push_back(*actions.goal);
    if (actions.pick) picks_.push_back(*actions.pick);
    if (actions.take_back) taken_back_.push_back(*actions.take_back);
    for (EggTrack& track : tracks_) {
      track.picked |= std::ranges::count(actions.picked_eggs, track.id) > 0;
    }
    return actions;
  }

  /// Steps until the mission asks for something new; answers the number of goals.
  void step_until_phase(MissionPhase phase, int limit = 100) {
    for (int i = 0; i < limit && mission_.state().phase != phase; ++i) step();
    ASSERT_EQ(mission_.state().phase, phase);
  }

  void arrive() {
    robot_ = goals_.back().pose_in_map;
    navigation_ = {goals_.back().goal_id, NavigationReport::State::kArrived, ""};
  }
  /// On the way.
  void fail_to_arrive(const std::string& reason) {
    robot_ = *robot_ * Pose2{0.5, 0, 0};
    refuse(reason);
  }
  /// Before the robot has moved.
  void refuse(const std::string& reason) {
    navigation_ = {goals_.back().goal_id, NavigationReport::State::kFailed, reason};
  }
  void answer_pick(bool picked, const std::string& reason = "") {
    pick_ = PickReport{mission_.state().pick_id, picked, true, reason};
  }

  Mission mission_;
  MapQueries queries_;
  Time now_ = time_from_seconds(100);
  std::optional<Pose2> robot_ = Pose2{0, 0, 0};
  std::optional<NavigationReport> navigation_;
  std::optional<PickReport> pick_;
  std::vector<EggTrack> tracks_;
  int pictures_ = 0;
  std::vector<GoalOrder> goals_;
  std::vector<PickOrder> picks_;
  std::vector<std::string> taken_back_;
};

}  // namespace coop::sequencer::test
