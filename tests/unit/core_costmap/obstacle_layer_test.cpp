#include "core/costmap/obstacle_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace coop {
namespace {

using State = ObstacleLayer::State;

const GridGeometry kGrid{40, 20, 0.1, {0.0, 0.0}};
const Footprint kFootprint({{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}});

/// A scan of single beams, all straight ahead or to the left, from base_link.
LaserScan scan_of(std::vector<float> ranges, double time) {
  LaserScan scan;
  scan.stamp = time_from_seconds(time);
  scan.angle_min = 0.0F;
  scan.angle_increment = std::numbers::pi_v<float> / 2.0F;
  scan.range_min = 0.05F;
  scan.range_max = 3.0F;
  scan.ranges = std::move(ranges);
  return scan;
}

ObstacleLayer::ScanPose at(double x, double y) {
  return {{x, y, 0.0}, {x, y, 0.0}, {}};
}

ObstacleLayer make_layer(const ObstacleLayerConfig& config = {}) {
  ObstacleLayer layer(config);
  layer.set_geometry(kGrid);
  return layer;
}

TEST(ObstacleLayer, MarksTheHitAndClearsTheWayToIt) {
  ObstacleLayer layer = make_layer();
  layer.integrate(scan_of({1.0F}, 10.0), at(0.55, 0.55), kFootprint);
  EXPECT_EQ(layer.state({4, 5}), State::kUnseen);  // behind the sensor
  EXPECT_EQ(layer.state({5, 5}), State::kClear);
  EXPECT_EQ(layer.state({14, 5}), State::kClear);
  EXPECT_EQ(layer.state({16, 5}),
            State::kMarked);  // 1.55 m is the border of two cells: the far one
  EXPECT_EQ(layer.state({17, 5}), State::kUnseen);
}

TEST(ObstacleLayer, ABeamThatHitsNothingClearsUpToTheRangeLimit) {
  ObstacleLayer layer = make_layer({.clearing_range = 8.0});
  layer.integrate(scan_of({std::numeric_limits<float>::infinity()}, 10.0), at(0.55, 0.55),
                  kFootprint);
  EXPECT_EQ(layer.state({34, 5}), State::kClear);
  EXPECT_EQ(layer.state({36, 5}), State::kUnseen);
}

TEST(ObstacleLayer, NanAndTooNearReadingsSayNothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kTooNear = -std::numeric_limits<float>::infinity();
  ObstacleLayer layer = make_layer({.hold_time = 0.0});
  layer.integrate(scan_of({kNan, 0.01F}, 10.0), at(0.55, 0.55), kFootprint);
  layer.integrate(scan_of({kTooNear, kNan}, 10.1), at(0.55, 0.55), kFootprint);
  for (const State state : layer.states()) EXPECT_EQ(state, State::kUnseen);
  layer.integrate(scan_of({1.0F}, 10.2), at(0.55, 0.55), kFootprint);
  for (const float silent : {kNan, kTooNear}) {
    layer.integrate(scan_of({silent}, 11.0), at(0.55, 0.55), kFootprint);
    EXPECT_EQ(layer.state({16, 5}), State::kMarked) << "a lost beam clears nothing";
  }
}

TEST(ObstacleLayer, AnObstacleThatLeftIsClearedOnceItsHoldTimeIsOver) {
  ObstacleLayer layer = make_layer({.hold_time = 0.25});
  layer.integrate(scan_of({1.0F}, 10.0), at(0.55, 0.55), kFootprint);
  layer.integrate(scan_of({2.0F}, 10.1), at(0.55, 0.55), kFootprint);
  EXPECT_EQ(layer.state({16, 5}), State::kMarked);
  layer.integrate(scan_of({2.0F}, 10.4), at(0.55, 0.55), kFootprint);
  EXPECT_EQ(layer.state({16, 5}), State::kClear);
}

TEST(ObstacleLayer, ABeamDoesNotClearWhatAnotherOfTheSameScanMarks) {
  ObstacleLayer layer = make_layer({.hold_time = 0.0});
  LaserScan scan = scan_of({2.0F, 1.0F}, 10.0);
  scan.angle_increment = 0.0F;  // both along x
  layer.integrate(scan, at(0.55, 0.55), kFootprint);
  EXPECT_EQ(layer.state({16, 5}), State::kMarked);
}

TEST(ObstacleLayer, HitsOnTheRobotItselfAreLeftOut) {
  ObstacleLayer layer = make_layer();
  layer.integrate(scan_of({0.08F}, 10.0), at(0.55, 0.55), kFootprint);
  for (const State state : layer.states()) EXPECT_NE(state, State::kMarked);
}

TEST(ObstacleLayer, FarHitsAreNotMarkedButClear) {
  ObstacleLayer layer = make_layer({.obstacle_range = 1.5});
  layer.integrate(scan_of({2.0F}, 10.0), at(0.55, 0.55), kFootprint);
  EXPECT_EQ(layer.state({24, 5}), State::kClear);
  for (const State state : layer.states()) EXPECT_NE(state, State::kMarked);
}

TEST(ObstacleLayer, MarksExpireWhenNobodySeesThemAgain) {
  ObstacleLayer layer = make_layer({.persistence = 5.0});
  layer.integrate(scan_of({1.0F}, 10.0), at(0.55, 0.55), kFootprint);
  layer.expire(time_from_seconds(14.9));
  EXPECT_EQ(layer.state({16, 5}), State::kMarked);
  layer.expire(time_from_seconds(15.1));
  EXPECT_EQ(layer.state({16, 5}), State::kUnseen);
}

TEST(ObstacleLayer, KeepsWhatItKnowsWhenTheGridMovesByWholeCells) {
  ObstacleLayer layer = make_layer();
  layer.integrate(scan_of({1.0F}, 10.0), at(0.55, 0.55), kFootprint);
  GridGeometry moved = kGrid;
  moved.origin = {0.3, 0.2};
  layer.set_geometry(moved);
  EXPECT_EQ(layer.state({13, 3}), State::kMarked);
  EXPECT_EQ(layer.state({11, 3}), State::kClear);
  EXPECT_EQ(layer.state({39, 19}), State::kUnseen);
}

TEST(ObstacleLayer, ForgetsAllWhenTheGridChangesItsCells) {
  ObstacleLayer layer = make_layer();
  layer.integrate(scan_of({1.0F}, 10.0), at(0.55, 0.55), kFootprint);
  layer.set_geometry({40, 20, 0.05, {0.0, 0.0}});
  for (const State state : layer.states()) EXPECT_EQ(state, State::kUnseen);
}

TEST(ObstacleLayer, BeamsBetweenFirstAndLastUseThePoseBetween) {
  ObstacleLayer layer = make_layer();
  LaserScan scan = scan_of({1.0F, 1.0F, 1.0F}, 10.0);
  scan.angle_increment = 0.0F;
  layer.integrate(scan, {{0.55, 0.55, 0.0}, {0.55, 1.55, 0.0}, {}}, kFootprint);
  EXPECT_EQ(layer.state({16, 5}), State::kMarked);
  EXPECT_EQ(layer.state({16, 10}), State::kMarked);
  EXPECT_EQ(layer.state({16, 15}), State::kMarked);
}

TEST(ObstacleLayer, ATimeSetBackDoesNotKeepOldMarksAlive) {
  ObstacleLayer layer = make_layer({.hold_time = 0.25});
  layer.integrate(scan_of({1.0F}, 10000.0), at(0.55, 0.55), kFootprint);
  layer.integrate(scan_of({2.0F}, 10.0), at(0.55, 0.55), kFootprint);
  EXPECT_EQ(layer.state({16, 5}), State::kClear);
}

TEST(ObstacleLayer, TellsWhereItHasChangedSinceItWasLastAsked) {
  ObstacleLayer layer = make_layer({.hold_time = 0.0, .persistence = 5.0});
  std::vector<CellWindow> changed;
  layer.take_changes(changed);
  EXPECT_FALSE(changed.empty()) << "at first everything is new";
  std::vector<State> before(layer.states().begin(), layer.states().end());
  const auto changes_are_told = [&] {
    layer.take_changes(changed);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Cell cell = layer.geometry().cell_at(i);
      const bool told = std::any_of(changed.begin(), changed.end(), [cell](const auto& window) {
        return cell.x >= window.low.x && cell.y >= window.low.y && cell.x < window.high.x &&
               cell.y < window.high.y;
      });
      if (before[i] != layer.states()[i] && !told) return false;
    }
    before.assign(layer.states().begin(), layer.states().end());
    return !changed.empty();
  };
  layer.integrate(scan_of({1.0F}, 10.0), at(0.55, 0.55), kFootprint);
  EXPECT_TRUE(changes_are_told()) << "a mark and the cells before it";
  layer.integrate(scan_of({1.0F}, 10.1), at(0.55, 0.55), kFootprint);
  EXPECT_FALSE(changes_are_told()) << "the same again";
  layer.integrate(scan_of({1.3F}, 11.0), at(0.55, 0.55), kFootprint);
  EXPECT_TRUE(changes_are_told()) << "the obstacle is farther away";
  layer.expire(time_from_seconds(20.0));
  EXPECT_TRUE(changes_are_told()) << "its mark has expired";
  layer.clear();
  EXPECT_TRUE(changes_are_told());
}

TEST(ScanPose, IsThatOfTheFirstAndOfTheLastBeam) {
  TransformBuffer transforms;
  transforms.insert_static("base_link", "laser_link", to_pose3({0.5, 0, 0}));
  transforms.insert("odom", "base_link", time_from_seconds(10.0), to_pose3({1, 0, 0}));
  LaserScan scan = scan_of({1.0F, 1.0F, 1.0F}, 10.0);
  scan.frame_id = "laser_link";
  scan.time_increment = 0.1F;  // three beams: two steps, 0.2 s
  const Pose3 base = to_pose3({1, 0, 0});
  const auto early = scan_pose(transforms, "odom", scan, base);
  ASSERT_TRUE(early);
  EXPECT_EQ(early->base_in_grid_last, early->base_in_grid_first) << "the last is not known yet";
  transforms.insert("odom", "base_link", time_from_seconds(10.4), to_pose3({2, 0, 0}));
  const auto pose = scan_pose(transforms, "odom", scan, base);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->base_in_grid_first.x, 1.0, 1e-9);
  EXPECT_NEAR(pose->base_in_grid_last.x, 1.5, 1e-6);
  EXPECT_NEAR(pose->laser_in_base.x, 0.5, 1e-9);
  scan.frame_id = "moon";
  EXPECT_FALSE(scan_pose(transforms, "odom", scan, base));
}

}  // namespace
}  // namespace coop
