#include "slam/tile_map.hpp"

#include <gtest/gtest.h>

namespace coop::slam {
namespace {

void hit(TileMap& map, Cell cell) {
  map.writable_tile_at(cell).at(cell.x, cell.y).add_hit(0.01F, 0.02F);
}
void pass(TileMap& map, Cell cell) {
  map.writable_tile_at(cell).at(cell.x, cell.y).add_pass();
}

TEST(MapCell, OccupancyIsTheShareOfVisitsThatEndedInTheCell) {
  MapCell cell;
  EXPECT_FALSE(cell.is_known());
  cell.add_hit(0.0F, 0.0F);
  cell.add_pass();
  cell.add_pass();
  cell.add_pass();
  EXPECT_TRUE(cell.is_known());
  EXPECT_FLOAT_EQ(cell.occupancy(), 0.25F);
}

TEST(MapCell, MeanIsThatOfTheBeamEndsOnly) {
  MapCell cell;
  cell.add_hit(0.01F, 0.04F);
  cell.add_pass();
  cell.add_hit(0.03F, 0.02F);
  EXPECT_FLOAT_EQ(cell.mean_x, 0.02F);
  EXPECT_FLOAT_EQ(cell.mean_y, 0.03F);
}

TEST(MapCell, CountsStopInsteadOfWrappingRound) {
  MapCell cell;
  for (int i = 0; i < 70'000; ++i) cell.add_hit(0.01F, 0.01F);
  cell.add_pass();
  EXPECT_EQ(cell.visits, UINT16_MAX);
  EXPECT_FLOAT_EQ(cell.occupancy(), 1.0F);
}

TEST(TileMap, UnwrittenCellsAreUnknownAndCostNothing) {
  const TileMap map(0.05);
  EXPECT_FALSE(map.at({-1000, 5000}).is_known());
  EXPECT_EQ(map.tile_count(), 0U);
}

TEST(TileMap, PointsBelongToTheCellWhoseLowerLeftCornerTheyPassed) {
  const TileMap map(0.1);
  EXPECT_EQ(map.cell_of({0.05, 0.15}), (Cell{0, 1}));
  EXPECT_EQ(map.cell_of({-0.05, -0.15}), (Cell{-1, -2}));
}

TEST(TileMap, GrowsInEveryDirectionAndKeepsWhatItHolds) {
  TileMap map(0.05);
  const Cell cells[] = {{0, 0}, {-1, -1}, {900, 3}, {-700, 2}, {5, 800}, {4, -1200}};
  for (const Cell cell : cells) hit(map, cell);
  for (const Cell cell : cells) EXPECT_EQ(map.at(cell).hits, 1) << cell.x << ", " << cell.y;
  EXPECT_FALSE(map.at({1, 1}).is_known());
  EXPECT_EQ(map.tile_count(), 6U);
}

TEST(TileMap, CopySharesAllTilesUntilOneHolderWrites) {
  TileMap original(0.05);
  hit(original, {0, 0});
  hit(original, {100, 0});
  hit(original, {200, 0});
  TileMap copy = original;
  EXPECT_EQ(original.shared_tile_count(), 3U);
  EXPECT_EQ(copy.shared_tile_count(), 3U);

  pass(copy, {100, 0});

  EXPECT_EQ(original.shared_tile_count(), 2U);
  EXPECT_EQ(copy.shared_tile_count(), 2U);
  EXPECT_EQ(copy.at({100, 0}).visits, 2);
  EXPECT_EQ(original.at({100, 0}).visits, 1) << "the other holder must not see the write";
}

TEST(TileMap, LastHolderWritesWithoutCopying) {
  TileMap map(0.05);
  hit(map, {0, 0});
  const Tile* before = nullptr;
  {
    const TileMap copy = map;
    before = map.tile_at({0, 0});
    EXPECT_EQ(copy.tile_at({0, 0}), before);
  }
  EXPECT_EQ(map.shared_tile_count(), 0U);
  pass(map, {0, 0});
  EXPECT_EQ(map.tile_at({0, 0}), before);
}

TEST(TileMap, WritingToAnUnsharedTileOfACopyLeavesTheOthersShared) {
  TileMap original(0.05);
  for (int x = 0; x < 10; ++x) hit(original, {x * kTileSide, 0});
  TileMap copy = original;
  hit(copy, {0, 10 * kTileSide});
  EXPECT_EQ(copy.tile_count(), 11U);
  EXPECT_EQ(copy.shared_tile_count(), 10U);
  EXPECT_EQ(original.tile_count(), 10U);
}

TEST(TileMap, OccupancyGridIsCroppedToTheKnownPlusAMargin) {
  TileMap map(0.5);
  hit(map, {-3, 2});
  pass(map, {1, 4});
  const OccupancyGrid grid = map.to_occupancy_grid(0.5, 1);
  EXPECT_EQ(grid.geometry.width, 7);   // -4 .. 2
  EXPECT_EQ(grid.geometry.height, 5);  // 1 .. 5
  EXPECT_DOUBLE_EQ(grid.geometry.origin.x(), -2.0);
  EXPECT_DOUBLE_EQ(grid.geometry.origin.y(), 0.5);
  EXPECT_EQ((grid[{1, 1}]), kOccupied);
  EXPECT_EQ((grid[{5, 3}]), kFree);
  EXPECT_EQ((grid[{0, 0}]), kUnknown);
}

TEST(TileMap, EmptyMapGivesAnEmptyGrid) {
  EXPECT_EQ(TileMap(0.05).to_occupancy_grid(0.5, 3).geometry.size(), 0U);
}

}  // namespace
}  // namespace coop::slam
