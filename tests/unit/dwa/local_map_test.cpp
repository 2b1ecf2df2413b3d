#include "dwa/local_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
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

/// A robot drives about between boxes that come and go; its place in the map is put right now and
/// then, spots come and go.
TEST(LocalMap, UpdatedWhereItChangedItIsTheSameAsMadeAnew) {
  LocalMap map = make_map({.size = 4.0, .resolution = 0.05});
  map.set_static_map(walls());
  RandomStream random(3, "local_map_test");
  Pose2 base;
  Pose2 odom_in_map;
  for (int step = 0; step < 120; ++step) {
    const Time now = kNow + std::chrono::milliseconds(50 * step);
    base = base * Pose2{random.uniform(-0.05, 0.1), 0.0, random.uniform(-0.2, 0.2)};
    if (step % 2 == 0) {
      LaserScan scan = beam(0.0);
      scan.stamp = now;
      scan.angle_increment = 0.1F;
      scan.ranges.clear();
      for (int i = 0; i < 62; ++i)
        scan.ranges.push_back(random.uniform(0.8, 1.6) < 1.0 ? 1.0F : 2.5F);
      map.integrate(scan, {base, base, {0.62, 0, 0}});
    }
    if (random.below(8) == 0) odom_in_map.x += random.uniform(-0.05, 0.05);
    if (random.below(10) == 0) map.set_spots({{{random.uniform(-1.0, 1.0), 1.0}, 0.1}});
    LocalMap anew = map;
    anew.set_static_map(walls());
    anew.update(base, odom_in_map, now);
    map.update(base, odom_in_map, now);
    ASSERT_EQ(map.costmap().costs(), anew.costmap().costs()) << "step " << step;
    ASSERT_TRUE(std::ranges::equal(map.costmap().distances().squared_cells(),
                                   anew.costmap().distances().squared_cells()));
  }
}

}  // namespace
}  // namespace coop::dwa
