#include "slam/map_updater.hpp"

#include <gtest/gtest.h>

namespace coop::slam {
namespace {

ScanPoints beams_to(std::vector<Eigen::Vector2f> ends) {
  ScanPoints points;
  points.ends = std::move(ends);
  return points;
}

TEST(MapUpdater, BeamPassesCellsOnItsWayAndEndsInItsLast) {
  TileMap map(1.0);
  MapUpdater().integrate(map, beams_to({{3.2F, 0.0F}}), {0.5, 0.5, 0.0});
  for (int x = 0; x < 3; ++x) {
    EXPECT_EQ(map.at({x, 0}).visits, 1) << x;
    EXPECT_EQ(map.at({x, 0}).hits, 0) << x;
  }
  EXPECT_EQ(map.at({3, 0}).hits, 1);
  EXPECT_NEAR(map.at({3, 0}).mean_x, 0.7, 1e-6) << "the beam ends at x = 3.7";
  EXPECT_NEAR(map.at({3, 0}).mean_y, 0.5, 1e-6);
  EXPECT_FALSE(map.at({4, 0}).is_known());
}

TEST(MapUpdater, BeamsStartAtTheLaserAndTurnWithTheRobot) {
  TileMap map(1.0);
  ScanPoints points = beams_to({{3.0F, 0.0F}});
  points.laser_in_base = {1.0, 0.0};
  MapUpdater().integrate(map, points, {0.5, 0.5, std::numbers::pi / 2});
  EXPECT_FALSE(map.at({0, 0}).is_known()) << "behind the laser nothing was seen";
  EXPECT_EQ(map.at({0, 1}).visits, 1);
  EXPECT_EQ(map.at({0, 2}).visits, 1);
  EXPECT_EQ(map.at({0, 3}).hits, 1);
}

TEST(MapUpdater, CellIsPassedOncePerScanHoweverManyBeamsCrossIt) {
  TileMap map(1.0);
  MapUpdater().integrate(map, beams_to({{5.0F, 0.0F}, {5.0F, 0.1F}, {5.0F, -0.1F}}),
                         {0.5, 0.5, 0.0});
  EXPECT_EQ(map.at({2, 0}).visits, 1);
  EXPECT_EQ(map.at({5, 0}).hits, 3);
}

TEST(MapUpdater, GrazingBeamsDoNotEatTheWallTheyEndIn) {
  // A wall along x; the last beam passes over the cells in which the others end.
  TileMap map(1.0);
  MapUpdater().integrate(map, beams_to({{2.0F, 0.0F}, {3.0F, 0.0F}, {6.0F, 0.0F}}),
                         {0.5, 0.5, 0.0});
  EXPECT_FLOAT_EQ(map.at({2, 0}).occupancy(), 1.0F);
  EXPECT_FLOAT_EQ(map.at({3, 0}).occupancy(), 1.0F);
  EXPECT_FLOAT_EQ(map.at({4, 0}).occupancy(), 0.0F);
}

TEST(MapUpdater, OpenBeamFreesCellsAndHitsNone) {
  TileMap map(1.0);
  ScanPoints points;
  points.open_ends = {{4.0F, 0.0F}};
  MapUpdater().integrate(map, points, {0.5, 0.5, 0.0});
  EXPECT_EQ(map.at({3, 0}).visits, 1);
  EXPECT_FALSE(map.at({4, 0}).is_known());
}

TEST(MapUpdater, WorksAcrossTilesAndNegativeCells) {
  TileMap map(0.05);
  MapUpdater updater;
  updater.integrate(map, beams_to({{-10.0F, -7.0F}, {9.0F, 8.0F}}), {0.0, 0.0, 0.0});
  EXPECT_EQ(map.at(map.cell_of({-10.0, -7.0})).hits, 1);
  EXPECT_EQ(map.at(map.cell_of({9.0, 8.0})).hits, 1);
  EXPECT_EQ(map.at(map.cell_of({-5.0, -3.5})).visits, 1);
  EXPECT_EQ(map.at(map.cell_of({4.5, 4.0})).visits, 1);
}

}  // namespace
}  // namespace coop::slam
