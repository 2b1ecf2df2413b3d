#include "slam/match_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coop::slam {
namespace {

constexpr MatchFieldConfig kConfig{
    .sigma = 0.1, .outlier_share = 0.1, .reach = 0.5, .occupied_threshold = 0.5};

double expected(double distance) {
  return std::log(0.9 * std::exp(-distance * distance / (2 * 0.1 * 0.1)) + 0.1);
}

/// One wall point at the middle of cell (10, 10).
TileMap one_point() {
  TileMap map(0.1);
  map.writable_tile_at({10, 10}).at(10, 10).add_hit(0.05F, 0.05F);
  return map;
}

TEST(MatchField, IsTheLogLikelihoodOfTheDistanceToTheNearestWall) {
  MatchField field(kConfig);
  field.build(one_point(), {0, 0}, {20, 20});
  EXPECT_EQ(field.wall_cells(), 1U);
  EXPECT_NEAR(field.at(10.5F, 10.5F), expected(0.0), 0.01);
  EXPECT_NEAR(field.at(11.5F, 10.5F), expected(0.1), 0.02);
  EXPECT_NEAR(field.at(11.5F, 11.5F), expected(0.1 * std::sqrt(2.0)), 0.02);
  EXPECT_NEAR(field.at(12.5F, 10.5F), expected(0.2), 0.02);
}

TEST(MatchField, KnowsWhereInTheCellTheWallIs) {
  TileMap map(0.1);
  map.writable_tile_at({10, 10}).at(10, 10).add_hit(0.0F, 0.05F);  // on the cell's left edge
  MatchField field(kConfig);
  field.build(map, {0, 0}, {20, 20});
  EXPECT_NEAR(field.at(9.5F, 10.5F), field.at(10.5F, 10.5F), 1e-3);
  EXPECT_GT(field.at(9.5F, 10.5F), field.at(11.5F, 10.5F) + 0.3F);
}

TEST(MatchField, FarFromWallsAndOutsideOfTheWindowAnEndIsAnOutlier) {
  MatchField field(kConfig);
  field.build(one_point(), {5, 5}, {15, 15});
  for (const auto& [x, y] :
       {std::pair{100.0F, 10.0F}, {-3.0F, 10.0F}, {10.0F, 15.9F}, {NAN, 10.0F}}) {
    EXPECT_EQ(field.at(x, y), field.outlier());
  }
  EXPECT_NEAR(field.outlier(), std::log(0.1), 1e-3);
}

TEST(MatchField, FreeAndDoubtfulCellsAreNoWalls) {
  TileMap map = one_point();
  MapCell& cell = map.writable_tile_at({10, 10}).at(10, 10);
  cell.add_pass();
  cell.add_pass();  // one hit in three visits
  MatchField field(kConfig);
  field.build(map, {0, 0}, {20, 20});
  EXPECT_EQ(field.wall_cells(), 0U);
  EXPECT_EQ(field.at(10.5F, 10.5F), field.outlier());
}

TEST(MatchField, WallsJustOutsideOfTheWindowReachIn) {
  MatchField field(kConfig);
  field.build(one_point(), {12, 0}, {20, 20});
  EXPECT_NEAR(field.at(12.5F, 10.5F), expected(0.2), 0.02);
}

}  // namespace
}  // namespace coop::slam
