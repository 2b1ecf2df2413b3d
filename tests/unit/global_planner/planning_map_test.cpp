#include "global_planner/planning_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
#include "unit/global_planner/drawn_map.hpp"

namespace coop::global_planner {
namespace {

using test::draw_room;
using test::kRobotFootprint;

LaserScan beam(double range, double time) {
  LaserScan scan;
  scan.stamp = time_from_seconds(time);
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges = {static_cast<float>(range)};
  return scan;
}

PlanningMap make_map(const PlanningMapConfig& config = {}) {
  PlanningMap map(config, Footprint(kRobotFootprint), 0.05, 0.8);
  map.set_map(draw_room());
  return map;
}

ObstacleLayer::ScanPose at(const Pose2& pose) {
  return {pose, pose, {}};
}

Cost cost_at(const PlanningMap& map, double x, double y) {
  return map.costmap().cost_at(map.map().geometry.cell_of({x, y}));
}

TEST(PlanningMap, HasNoCostsWithoutAMap) {
  PlanningMap map({}, Footprint(kRobotFootprint), 0.05, 0.8);
  EXPECT_FALSE(map.has_map());
  EXPECT_FALSE(map.update(Time{}));
}

TEST(PlanningMap, InscribedZoneReachesToTheHalfWidthAndThePadding) {
  PlanningMap map = make_map();
  EXPECT_TRUE(map.update(Time{}));
  // The wall's last cell has its middle at y = 0.475 m; 0.28 m + 0.05 m further is 0.805 m.
  EXPECT_EQ(cost_at(map, 3.0, 0.48), kLethalCost);
  EXPECT_EQ(cost_at(map, 3.0, 0.77), kInscribedCost);
  EXPECT_EQ(zone_of(cost_at(map, 3.0, 0.83)), Zone::kRestrictedZone);
  EXPECT_EQ(cost_at(map, 3.0, 2.5), kFreeCost);
}

TEST(PlanningMap, TellsWhetherAnythingChanged) {
  PlanningMap map = make_map();
  EXPECT_TRUE(map.update(Time{}));
  EXPECT_FALSE(map.update(Time{}));
  map.integrate(beam(1.0, 10.0), at({2.0, 2.5, 0.0}));
  EXPECT_TRUE(map.update(time_from_seconds(10.0)));
}

TEST(PlanningMap, AddsWhatTheLaserSeesAndTakesItAwayAgain) {
  PlanningMap map = make_map();
  map.integrate(beam(1.0, 10.0), at({2.0, 2.52, 0.0}));
  map.update(time_from_seconds(10.0));
  EXPECT_EQ(cost_at(map, 3.03, 2.52), kLethalCost);
  map.integrate(beam(2.0, 11.0), at({2.0, 2.52, 0.0}));
  map.update(time_from_seconds(11.0));
  EXPECT_NE(cost_at(map, 3.03, 2.52), kLethalCost);
  EXPECT_EQ(cost_at(map, 4.03, 2.52), kLethalCost);
}

TEST(PlanningMap, AHitBesideAWallIsTheWall) {
  PlanningMap map = make_map({.static_tolerance = 0.10});
  // The wall's face is at x = 5.5 m.
  map.integrate(beam(3.42, 10.0), at({2.0, 2.52, 0.0}));
  map.update(time_from_seconds(10.0));
  EXPECT_NE(cost_at(map, 5.44, 2.52), kLethalCost);
  map.integrate(beam(3.25, 10.1), at({2.0, 2.52, 0.0}));
  map.update(time_from_seconds(10.1));
  EXPECT_EQ(cost_at(map, 5.27, 2.52), kLethalCost);
}

TEST(PlanningMap, KeepsClearOfSpotsThatTheLaserDoesNotSee) {
  PlanningMap map = make_map();
  map.set_spots({{{3.02, 2.52}, 0.05}});
  EXPECT_TRUE(map.update(Time{}));
  EXPECT_EQ(cost_at(map, 3.02, 2.52), kLethalCost);
  EXPECT_EQ(cost_at(map, 3.02, 2.72), kInscribedCost);
  map.set_spots({});
  EXPECT_TRUE(map.update(Time{}));
  EXPECT_EQ(cost_at(map, 3.02, 2.52), kFreeCost);
}

TEST(PlanningMap, KeepsWhatTheLaserSawWhenTheMapGrows) {
  PlanningMap map = make_map();
  map.integrate(beam(1.0, 10.0), at({2.0, 2.52, 0.0}));
  OccupancyGrid grown = draw_room();
  GridGeometry geometry = grown.geometry;
  geometry.width += 20;
  geometry.height += 20;
  geometry.origin = {-1.0, -1.0};
  OccupancyGrid larger(geometry, kUnknown);
  for (std::size_t i = 0; i < grown.cells.size(); ++i) {
    const Cell cell = grown.geometry.cell_at(i);
    larger[{cell.x + 20, cell.y + 20}] = grown.cells[i];
  }
  map.set_map(larger);
  map.update(time_from_seconds(10.0));
  EXPECT_EQ(cost_at(map, 3.03, 2.52), kLethalCost);
}

TEST(PlanningMap, AnAnimalIsAnObstacleForAsLongAsItIsSeen) {
  PlanningMap map = make_map();
  Detection pig;
  pig.position = {3.0, 2.5, 0.2};
  pig.size = {0.4, 0.4, 0.4};
  EXPECT_TRUE(map.animals().see({pig}, time_from_seconds(1.0)));
  EXPECT_TRUE(map.update(time_from_seconds(1.0)));
  EXPECT_EQ(cost_at(map, 3.0, 2.5), kLethalCost);
  EXPECT_TRUE(map.update(time_from_seconds(3.0)));
  EXPECT_EQ(cost_at(map, 3.0, 2.5), kFreeCost);
}

/// Scans, animals that walk, spots that come and go, and a robot that drives over some.
TEST(PlanningMap, UpdatedWhereItChangedItIsTheSameAsMadeAnew) {
  OccupancyGrid room = draw_room();
  for (int y = 40; y < 60; ++y) {
    for (int x = 40; x < 60; ++x) room[{x, y}] = kUnknown;
  }
  PlanningMap map({.obstacles = {.persistence = 3.0}}, Footprint(kRobotFootprint), 0.05, 0.8);
  map.set_map(room);
  RandomStream random(7, "planning_map_test");
  int updates = 0;
  for (int step = 0; step < 150; ++step) {
    const double time = 10.0 + 0.1 * step;
    const Pose2 robot{random.uniform(1.5, 3.0), 2.5, random.uniform(-3.0, 3.0)};
    map.integrate(beam(random.uniform(0.5, 3.0), time), at(robot));
    if (random.below(4) == 0) map.set_spots({{{random.uniform(1.0, 5.0), 3.0}, 0.05}});
    Detection pig;
    pig.position = {1.0 + 0.02 * step, 2.0, 0.2};
    pig.size = {0.4, 0.4, 0.4};
    if (step % 50 < 30) {
      EXPECT_TRUE(map.animals().see({pig}, time_from_seconds(time)));
    }
    PlanningMap anew = map;
    anew.set_map(room);
    ASSERT_TRUE(anew.update(time_from_seconds(time), robot));
    // Costs wait for an obstacle that changes.
    if (!map.update(time_from_seconds(time), robot)) continue;
    ++updates;
    ASSERT_EQ(map.costmap().costs(), anew.costmap().costs()) << "step " << step;
    ASSERT_TRUE(std::ranges::equal(map.costmap().distances().squared_cells(),
                                   anew.costmap().distances().squared_cells()));
  }
  EXPECT_GT(updates, 100);
}

}  // namespace
}  // namespace coop::global_planner
