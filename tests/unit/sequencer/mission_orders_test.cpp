// The mission and its orders against a world of chance: eggs are seen on the way, ways open and
// close, arms answer late, the mission is paused, dies and comes back.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "sequencer/journal.hpp"
#include "sequencer/ordering.hpp"
#include "unit/sequencer/cost_matrices.hpp"
#include "unit/sequencer/mission_fixture.hpp"

namespace coop::sequencer {
namespace {

class MissionOrdersTest : public test::MissionTest {
 protected:
  static MissionConfig config() {
    MissionConfig config;
    config.max_attempts = 4;
    config.pick_timeout = 6.0;
    config.goal_timeout = 30.0;
    config.unseen_after = 3;
    return config;
  }

  /// A new world, and its chances.
  void begin(std::uint64_t seed) {
    random_ = RandomStream(seed, "chance");
    streams_ = {RandomStream(seed, "paper"), RandomStream(seed, "best")};
    method_ = seed % 2 == 0 ? OrderingMethod::kBest : OrderingMethod::kPaper;
    most_eggs_ = 2 + random_.below(seed % 5 == 0 ? 18 : 6);
    tracks_.clear();
    goals_.clear();
    blocked_.clear();
    taken_away_.clear();
    in_basket_.clear();
    reported_.clear();
    answers_.clear();
    coming_.clear();
    pick_.reset();
    navigation_.reset();
    robot_ = Pose2{0, 0, 0};
    queries_.order = [this](const Pose2& robot, const std::vector<const EggTask*>& eggs) {
      return order(robot, eggs);
    };
    queries_.pose_cost = [this](const Pose2& pose) { return pose_cost(pose); };
    mission_ = Mission(config(), {});
    mission_.start(MissionKind::kCollect, "m", {{"gate", {1, 0, 0}}, {"wall", {5, 5, 0}}});
  }

  OrderedEggs order(const Pose2& robot, const std::vector<const EggTask*>& eggs) {
    std::vector<Eigen::Vector2d> places{robot.position()};
    for (const EggTask* egg : eggs) places.push_back(egg->egg_in_map);
    CostMatrix costs = test::distances(places);
    for (std::size_t i = 0; i < eggs.size(); ++i) {
      if (!blocked_.contains(eggs[i]->id)) continue;
      for (std::size_t j = 0; j < costs.size; ++j) {
        costs.at(i + 1, j) = costs.at(j, i + 1) = std::numeric_limits<double>::infinity();
      }
    }
    AntColonyConfig colony;
    colony.ants = 5;
    colony.iterations = 5;
    MaxMinConfig max_min;
    max_min.ants = 2;
    max_min.iterations = 5;
    const Ordering ordering = order_nodes(costs, method_, colony, max_min, streams_);
    OrderedEggs result;
    result.cost = ordering.tour.cost;
    for (const std::size_t node : ordering.tour.order) result.order.push_back(eggs[node - 1]->id);
    for (const std::size_t node : ordering.unreachable) {
      result.order.push_back(eggs[node - 1]->id);
    }
    return result;
  }

  std::optional<double> pose_cost(const Pose2& pose) const {
    for (const EggTrack& track : tracks_) {
      if (blocked_.contains(track.id) && (track.egg_in_map - pose.position()).norm() < 1.0) {
        return std::nullopt;
      }
    }
    return distance(*robot_, pose);
  }

  [[nodiscard]] bool happens(double probability) { return random_.uniform() < probability; }

  /// One of the eggs; there are some.
  const std::string& any_egg() { return tracks_[random_.below(tracks_.size())].id; }
  static void toggle(std::set<std::string>& eggs, const std::string& id) {
    if (!eggs.insert(id).second) eggs.erase(id);
  }
  [[nodiscard]] bool lies_there(const std::string& id) const {
    return !in_basket_.contains(id) && !taken_away_.contains(id);
  }

  void change_the_world() {
    if (happens(tracks_.size() < 2 ? 0.5 : 0.05) && tracks_.size() < most_eggs_) {
      const auto number = static_cast<double>(tracks_.size());  // 3 m apart
      add_egg("egg" + std::to_string(tracks_.size() + 1), 3.0 * std::fmod(number, 5.0) + 2.0,
              3.0 * std::floor(number / 5.0) + 2.0);
    }
    if (happens(0.03) && !tracks_.empty()) toggle(blocked_, any_egg());
    if (happens(0.01) && !tracks_.empty()) toggle(taken_away_, any_egg());
    for (EggTrack& track : tracks_) {
      if (!happens(0.7)) continue;
      const bool with = lies_there(track.id) && happens(0.9);
      track.seen_in_row = with ? track.seen_in_row + 1 : 0;
      track.unseen_in_row = with ? 0 : track.unseen_in_row + 1;
    }
  }

  void disturb_the_mission() {
    if (happens(0.01)) mission_.pause();
    if (happens(0.1)) mission_.resume();
    if (!happens(0.01)) return;
    const auto saved =
        Journal::last_state(to_line(mission_.state()));  // dies, and is read from the journal
    ASSERT_TRUE(saved);
    mission_ = Mission(config(), {});
    mission_.restore(*saved);
  }

  void drive() {
    if (goals_.empty()) return;
    if (happens(0.3)) {
      arrive();
    } else if (happens(0.05)) {
      fail_to_arrive("chance");
    } else if (happens(0.05)) {
      refuse("chance");
    }
  }

  /// The arm picks what is there, now and then answers too late, and answers each id once and for
  /// all.
  void move_the_arm(const MissionActions& actions) {
    if (actions.pick) {
      const PickOrder& pick = *actions.pick;
      ASSERT_FALSE(reported_.contains(pick.egg_id)) << "it knows that the egg is in the basket";
      if (!answers_.contains(pick.pick_id)) {
        const bool picks = lies_there(pick.egg_id) && happens(0.7);
        if (picks) in_basket_.insert(pick.egg_id);
        answers_[pick.pick_id] = {pick.pick_id, picks, true, picks ? "" : "no vacuum"};
        coming_.emplace(now_ + seconds(random_.uniform(0.5, happens(0.3) ? 20.0 : 3.0)),
                        pick.pick_id);
      }
    }
    if (coming_.empty() || coming_.begin()->first > now_) return;
    pick_ = answers_.at(coming_.begin()->second);
    coming_.erase(coming_.begin());
  }

  /// Once each, and none that is open left out.
  void check_order() {
    const MissionState& state = mission_.state();
    const std::set<std::string> ordered(state.order.begin(), state.order.end());
    ASSERT_EQ(ordered.size(), state.order.size()) << "an egg stands twice in the order";
    for (const EggTask& egg : state.eggs) {
      const bool is_open = egg.phase == EggPhase::kQueued || egg.phase == EggPhase::kApproaching ||
                           egg.phase == EggPhase::kPicking || egg.phase == EggPhase::kSeen;
      if (is_open) {
        ASSERT_TRUE(ordered.contains(egg.id)) << egg.id << " is left out";
      }
    }
    const EggTask* current = state.find_egg(state.current_egg);
    ASSERT_NE(current, nullptr);
    ASSERT_NE(current->phase, EggPhase::kPicked);
  }

  /// Until the mission ends.
  void run() {
    for (int i = 0; i < 6000 && mission_.state().is_active(); ++i) {
      change_the_world();
      disturb_the_mission();
      drive();
      const MissionPhase before = mission_.state().phase;
      const MissionActions actions = step(0.3);
      for (const std::string& id : actions.picked_eggs) {
        ASSERT_TRUE(reported_.insert(id).second) << "picked twice";
        ASSERT_TRUE(in_basket_.contains(id));
      }
      if (before == MissionPhase::kOrdering && mission_.state().phase == MissionPhase::kDriving) {
        check_order();
      }
      move_the_arm(actions);
      if (HasFatalFailure()) return;
    }
    ASSERT_FALSE(mission_.state().is_active()) << "it never ends";
  }

  RandomStream random_{1, "chance"};
  OrderingStreams streams_{RandomStream(1, "paper"), RandomStream(1, "best")};
  OrderingMethod method_ = OrderingMethod::kBest;
  std::uint64_t most_eggs_ = 0;
  std::set<std::string> blocked_;
  std::set<std::string> taken_away_;  ///< by a duck, perhaps brought back
  std::set<std::string> in_basket_;
  std::set<std::string> reported_;
  std::map<std::string, PickReport> answers_;  ///< by pick id
  std::multimap<Time, std::string> coming_;
};

TEST_F(MissionOrdersTest, NoEggIsLostOrVisitedTwiceWhateverHappens) {
  std::map<EggPhase, int> ends;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    begin(seed);
    run();
    if (HasFatalFailure()) return;
    std::set<std::string> unanswered;
    for (const auto& [time, id] : coming_) unanswered.insert(id);
    if (pick_) unanswered.insert(pick_->pick_id);  // it may have come after the last step
    for (const EggTask& egg : mission_.state().eggs) {
      ++ends[egg.phase];
      EXPECT_TRUE(egg.phase == EggPhase::kPicked || egg.phase == EggPhase::kFailed ||
                  egg.phase == EggPhase::kMissing)
          << egg.id;
      EXPECT_EQ(egg.phase == EggPhase::kPicked, reported_.contains(egg.id)) << egg.id;
      EXPECT_EQ(egg.reason.empty(), egg.phase == EggPhase::kPicked) << egg.id;
    }
    // Whatever is in the basket is known to be, unless the arm has still to say so.
    EXPECT_LE(in_basket_.size(), reported_.size() + unanswered.size());
  }
  EXPECT_GT(ends[EggPhase::kPicked], 300) << "each case occurs";
  EXPECT_GT(ends[EggPhase::kFailed], 30);
  EXPECT_GT(ends[EggPhase::kMissing], 3);
}

TEST_F(MissionOrdersTest, AnAnswerThatComesLateCountsAllTheSame) {
  begin(1);
  mission_.start(MissionKind::kCollect, "late", {});
  add_egg("egg1", 3, 0);
  step_until_phase(MissionPhase::kDriving);
  step();
  arrive();
  step_until_phase(MissionPhase::kPicking);
  const std::string pick_id = mission_.state().pick_id;
  for (int i = 0; i < 30 && mission_.state().phase == MissionPhase::kPicking; ++i) step(0.5);
  ASSERT_EQ(mission_.state().eggs[0].phase, EggPhase::kQueued) << "given up";
  step_until_phase(MissionPhase::kDriving);
  pick_ = PickReport{pick_id, true, true, ""};
  EXPECT_EQ(step().picked_eggs, std::vector<std::string>{"egg1"});
  EXPECT_EQ(mission_.state().eggs[0].phase, EggPhase::kPicked);
  step_until_phase(MissionPhase::kDone);
}

TEST_F(MissionOrdersTest, SidesRefusedBeforeAPauseDoNotCountForTheDriveAfterIt) {
  begin(1);
  approach_an_egg();
  refuse("chance");
  step();
  mission_.pause();
  step();
  mission_.resume();
  step_until_phase(MissionPhase::kDriving);
  step();
  EXPECT_EQ(egg().attempts, 2) << "else its pick would have the id of an earlier one";
}

TEST_F(MissionOrdersTest, ALongPauseIsNotTheArmsFault) {
  begin(1);
  approach_an_egg();
  arrive_and_pick();
  mission_.pause();
  step(60.0);
  mission_.resume();
  EXPECT_TRUE(step().pick) << "told again under its id";
  EXPECT_EQ(mission_.state().phase, MissionPhase::kPicking);
}

}  // namespace
}  // namespace coop::sequencer
