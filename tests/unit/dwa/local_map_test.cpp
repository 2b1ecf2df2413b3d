#include "dwa/local_map.hpp"

#include <gtest/gtest.h>

#include "unit/dwa/test_base.hpp"

namespace coop::dwa {
namespace {

const Time kNow = time_from_seconds(10.0);

LaserScan beam(double range) {
  LaserScan scan;
  scan.stamp = kNow;
  scan.range_min = 0.1F;
  scan.range_max = 8.0F;
  scan.ranges = {static_cast<float>(range)};
  return scan;
}

LocalMap make_map(const LocalMapConfig& config = {}) {
  return LocalMap(config, Footprint(test::kBaseFootprint), 1.0);
}

bool blocked(const LocalMap& map, double x, double y) {
  const GridGeometry& grid = map.costmap().geometry();
  return map.costmap().cost_at(grid.cell_of({x, y})) == kLethalCost;
}

/// A wall across x = 2.0 to 2.1 m and one across x = -1.6 to -1.5 m, in the map's frame.
OccupancyGrid walls() {
  OccupancyGrid map({120, 80, 0.05, {-3.0, -2.0}}, kFree);
  for (int y = 0; y < map.geometry.height; ++y) {
    for (const double x : {2.025, 2.075, -1.575, -1.525})
      map[map.geometry.cell_of({x, -2.0 + 0.05 * (y + 0.5)})] = kOccupied;
  }
  return map;
}

TEST(LocalMap, MarksWhatTheLaserSees) {
  LocalMap map = make_map();
  map.integrate(beam(1.5), {{0, 0, 0}, {0, 0, 0}, {0.62, 0, 0}});
  map.update({0, 0, 0}, {}, kNow);
  EXPECT_TRUE(blocked(map, 2.135, 0.0));
  EXPECT_FALSE(blocked(map, 1.5, 0.0));
}

TEST(LocalMap, GoesWithTheRobotAndKeepsWhatItSaw) {
  LocalMap map = make_map();
  map.integrate(beam(1.5), {{0, 0, 0}, {0, 0, 0}, {0.62, 0, 0}});
  map.update({1.0, 0.5, 0.0}, {}, kNow);
  const GridGeometry& grid = map.costmap().geometry();
  const Eigen::Vector2d middle =
      grid.origin + 0.5 * grid.resolution * Eigen::Vector2d(grid.width, grid.height);
  EXPECT_NEAR((middle - Eigen::Vector2d(1.0, 0.5)).norm(), 0.0, 0.05);
  EXPECT_TRUE(blocked(map, 2.135, 0.0));
}

TEST(LocalMap, ObstaclesOfTheMapStandInWhereTheLaserHasNotLooked) {
  LocalMap map = make_map();
  map.set_static_map(walls());
  map.update({0, 0, 0}, {}, kNow);
  EXPECT_TRUE(blocked(map, 2.05, 0.0));
  EXPECT_TRUE(blocked(map, -1.55, 0.0));
}

TEST(LocalMap, TheMapIsPlacedByThePoseOfOdomInIt) {
  LocalMap map = make_map();
  map.set_static_map(walls());
  map.update({0, 0, 0}, {0.5, 0.0, 0.0}, kNow);  // odom lies 0.5 m further along x in the map
  EXPECT_TRUE(blocked(map, 1.55, 0.0));
  EXPECT_FALSE(blocked(map, 2.05, 0.0));
}

TEST(LocalMap, AWallSeenBesideItsPlaceInTheMapIsOneWall) {
  LocalMap map = make_map({.static_tolerance = 0.15});
  map.set_static_map(walls());
  // The laser sees the wall at 1.93 m where the map has it from 2.0 m on: an error of localisation.
  map.integrate(beam(1.31), {{0, 0, 0}, {0, 0, 0}, {0.62, 0, 0}});
  map.update({0, 0, 0}, {}, kNow);
  EXPECT_TRUE(blocked(map, 1.945, 0.0));
  EXPECT_FALSE(blocked(map, 2.05, 0.0));
  EXPECT_TRUE(blocked(map, 2.05, 0.5));  // there nobody looked
}

TEST(LocalMap, WithoutUseOfTheMapOnlyTheLaserCounts) {
  LocalMap map = make_map({.use_map = false});
  map.set_static_map(walls());
  map.update({0, 0, 0}, {}, kNow);
  EXPECT_FALSE(blocked(map, 2.05, 0.0));
}

TEST(LocalMap, KeepsClearOfSpotsButNotOfThoseUnderTheRobot) {
  LocalMap map = make_map();
  map.set_spots({{{1.5, 0.0}, 0.05}, {{0.3, 0.0}, 0.05}});
  map.update({0, 0, 0}, {}, kNow);
  EXPECT_TRUE(blocked(map, 1.5, 0.0));
  EXPECT_FALSE(blocked(map, 0.3, 0.0));
}

}  // namespace
}  // namespace coop::dwa
