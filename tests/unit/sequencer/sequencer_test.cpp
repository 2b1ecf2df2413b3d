#include "sequencer/sequencer.hpp"

#include <gtest/gtest.h>

#include <set>

namespace coop::sequencer {
namespace {

/// 10 m x 6 m of free floor with a closed chamber in the east; 0.1 m a cell.
class SequencerTest : public ::testing::Test {
 protected:
  SequencerTest() : floor_({.width = 100, .height = 60, .resolution = 0.1, .origin = {0, 0}}, 0) {
    for (int y = 0; y < 60; ++y) floor_[{90, y}] = 100;
  }

  static SequencerConfig config(const std::string& method) {
    SequencerConfig config;
    config.method = method;
    config.traversal.allow_unknown = false;
    return config;
  }
  static MissionState state_with(const std::vector<Eigen::Vector2d>& places) {
    MissionState state;
    state.mission_id = "m";
    state.phase = MissionPhase::kOrdering;
    for (std::size_t i = 0; i < places.size(); ++i) {
      EggTask& egg = state.eggs.emplace_back();
      egg.id = "egg" + std::to_string(i + 1);
      egg.egg_in_map = places[i];
    }
    return state;
  }
  /// Of eggs at these places, in one step of the mission.
  std::vector<std::string> order(const SequencerConfig& config,
                                 const std::vector<Eigen::Vector2d>& places) {
    Sequencer sequencer(config, robot_, RandomStream(1, "ant_colony"));
    sequencer.set_costmap(floor_);
    sequencer.restore(state_with(places), now_);
    MissionSnapshot snapshot;
    snapshot.robot_in_map = Pose2{1.05, 3.05, 0};
    (void)sequencer.step(snapshot, now_);
    tour_cost_ = sequencer.mission().state().tour_cost;
    return sequencer.mission().state().order;
  }
  static std::vector<Eigen::Vector2d> scattered(std::size_t count) {
    RandomStream random(1, "eggs");
    std::vector<Eigen::Vector2d> places;
    for (std::size_t i = 0; i < count; ++i) {
      places.emplace_back(random.uniform(0.5, 8.5), random.uniform(0.5, 5.5));
    }
    return places;
  }

  OccupancyGrid floor_;
  Footprint robot_{{{-0.2, -0.2}, {0.8, -0.2}, {0.8, 0.2}, {-0.2, 0.2}}};
  Time now_ = time_from_seconds(100);
  double tour_cost_ = 0.0;
};

TEST_F(SequencerTest, EggsThatNoWayLeadsToStandLastInTheOrder) {
  for (const char* method : {"paper", "best"}) {
    const auto ids = order(config(method), {{9.5, 3}, {4, 3}, {2, 3}, {9.6, 1}, {6, 3}});
    EXPECT_EQ(ids, (std::vector<std::string>{"egg3", "egg2", "egg5", "egg1", "egg4"})) << method;
    EXPECT_NEAR(tour_cost_, 5.0, 0.3);
  }
}

TEST_F(SequencerTest, OfManyEggsTheNearestAreOrderedTogetherAndTheOthersFollow) {
  SequencerConfig few = config("best");
  few.max_together = 2;
  const auto ids = order(few, {{8, 3}, {2, 3}, {5, 3}, {3, 3}, {6, 3}});
  EXPECT_EQ(ids, (std::vector<std::string>{"egg2", "egg4", "egg3", "egg5", "egg1"}));
}

TEST_F(SequencerTest, TheMethodsAgreeOnAHandfulOfEggs) {
  const auto places = scattered(5);
  const auto by_paper = order(config("paper"), places);
  EXPECT_EQ(order(config("best"), places), by_paper);
}

TEST_F(SequencerTest, TheSameSeedGivesTheSameOrder) {
  const auto places = scattered(40);
  const auto once = order(config("best"), places);
  EXPECT_EQ(order(config("best"), places), once);
  EXPECT_EQ(once.size(), 40U);
}

TEST_F(SequencerTest, TenThousandEggsAreOrderedEachOnce) {
  const auto ids = order(config("best"), scattered(10000));
  EXPECT_EQ(ids.size(), 10000U);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), 10000U);
}

}  // namespace
}  // namespace coop::sequencer
