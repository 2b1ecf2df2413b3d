#include "core/costmap/costmap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace coop {
namespace {

/// One obstacle at the left end of a row of 10 cm cells.
Costmap row_with_obstacle(const InflationConfig& config, double inscribed_radius) {
  Costmap costmap(config, inscribed_radius);
  costmap.reset({12, 1, 0.1, {0.0, 0.0}});
  costmap.obstacles()[0] = 1;
  costmap.update();
  return costmap;
}

TEST(Costmap, HasTheFourZonesByDistance) {
  const Costmap costmap = row_with_obstacle({.inflation_radius = 0.6, .cost_scaling = 4.0}, 0.25);
  EXPECT_EQ(zone_of(costmap.cost_at({0, 0})), Zone::kLethalZone);
  EXPECT_EQ(zone_of(costmap.cost_at({1, 0})), Zone::kInscribedZone);  // 0.1 m
  EXPECT_EQ(zone_of(costmap.cost_at({2, 0})), Zone::kInscribedZone);  // 0.2 m
  EXPECT_EQ(zone_of(costmap.cost_at({3, 0})), Zone::kRestrictedZone);
  EXPECT_EQ(zone_of(costmap.cost_at({6, 0})), Zone::kRestrictedZone);  // 0.6 m
  EXPECT_EQ(zone_of(costmap.cost_at({7, 0})), Zone::kFreeZone);
  EXPECT_EQ(zone_of(costmap.cost_at({11, 0})), Zone::kFreeZone);
}

TEST(Costmap, RestrictedCostDecaysFromTheInscribedRadius) {
  const Costmap costmap = row_with_obstacle({.inflation_radius = 0.6, .cost_scaling = 4.0}, 0.25);
  // 252 exp(-4 (0.3 - 0.25)) = 206.3, 252 exp(-4 (0.6 - 0.25)) = 62.1
  EXPECT_EQ(costmap.cost_at({3, 0}), 206);
  EXPECT_EQ(costmap.cost_at({6, 0}), 62);
}

TEST(Costmap, RestrictedCostNeverLooksFree) {
  const Costmap costmap = row_with_obstacle({.inflation_radius = 0.9, .cost_scaling = 50.0}, 0.05);
  EXPECT_EQ(costmap.cost_at({9, 0}), 1);
  EXPECT_EQ(costmap.cost_at({10, 0}), kFreeCost);
}

TEST(Costmap, UnknownCellsKeepTheirOwnMarkUnlessTheyAreObstacles) {
  Costmap costmap({.inflation_radius = 0.3, .cost_scaling = 4.0}, 0.1);
  costmap.reset({3, 1, 0.1, {0.0, 0.0}});
  costmap.obstacles()[0] = 1;
  costmap.unknown()[0] = 1;
  costmap.unknown()[1] = 1;
  costmap.update();
  EXPECT_EQ(costmap.cost_at({0, 0}), kLethalCost);
  EXPECT_EQ(costmap.cost_at({1, 0}), kUnknownCost);
  EXPECT_NE(costmap.cost_at({2, 0}), kUnknownCost);
}

TEST(Costmap, WithoutObstaclesEverythingIsFree) {
  Costmap costmap({}, 0.2);
  costmap.reset({4, 4, 0.1, {0.0, 0.0}});
  costmap.update();
  for (const Cost cost : costmap.costs().cells) EXPECT_EQ(cost, kFreeCost);
}

TEST(Costmap, BeyondTheBorderIsLethal) {
  const Costmap costmap = row_with_obstacle({}, 0.2);
  EXPECT_EQ(costmap.cost_at({-1, 0}), kLethalCost);
}

TEST(Costmap, KnowsDistancesUpToTheReachOfTheCollisionCheck) {
  Costmap costmap({.inflation_radius = 0.2, .cost_scaling = 4.0}, 0.1, 0.8);
  costmap.reset({12, 1, 0.1, {0.0, 0.0}});
  costmap.obstacles()[0] = 1;
  costmap.update();
  EXPECT_NEAR(costmap.distances().distance_at({0.75, 0.05}), 0.7, 1e-9);
}

/// A few cells changed at random, each in its window, or all in a larger one.
std::vector<CellWindow> change(Costmap& costmap, RandomStream& random, bool clear_all) {
  std::vector<CellWindow> changed;
  const GridGeometry& geometry = costmap.geometry();
  for (std::size_t count = 1 + random.below(8); count > 0; --count) {
    const Cell cell = geometry.cell_at(random.below(geometry.size()));
    // Windows may stick out of the grid and overlap.
    const int side = static_cast<int>(random.below(9));
    changed.push_back({{cell.x - side / 2, cell.y - side / 3}, {cell.x + side, cell.y + side}});
    for (int y = std::max(0, cell.y - side / 3); y < std::min(geometry.height, cell.y + side);
         ++y) {
      for (int x = std::max(0, cell.x - side / 2); x < std::min(geometry.width, cell.x + side);
           ++x) {
        const std::size_t index = geometry.index({x, y});
        costmap.obstacles()[index] = !clear_all && random.uniform() < 0.3 ? 1 : 0;
        if (random.uniform() < 0.2) costmap.unknown()[index] ^= 1;
      }
    }
  }
  return changed;
}

TEST(Costmap, UpdatedWhereItChangedEqualsOneMadeAnewToTheBit) {
  RandomStream random(21, "costmap_test");
  for (int trial = 0; trial < 40; ++trial) {
    const GridGeometry geometry{1 + static_cast<int>(random.below(trial % 8 == 0 ? 1200 : 90)),
                                1 + static_cast<int>(random.below(90)),
                                0.05,
                                {0.0, 0.0}};
    const InflationConfig config{.inflation_radius = trial % 3 == 0 ? 0.2 : 1.0};
    // Beyond the small caps too: there all is made anew.
    const double reach = trial % 10 == 9 ? 7.0 : 0.0;
    Costmap costmap(config, 0.1, reach);
    Costmap anew(config, 0.1, reach);
    costmap.reset(geometry);
    for (std::uint8_t& cell : costmap.obstacles()) cell = random.uniform() < 0.02 ? 1 : 0;
    costmap.update(std::span<const CellWindow>{});  // the first one is a full one
    for (int round = 0; round < 12; ++round) {
      costmap.update(change(costmap, random, round % 4 == 3));
      anew.reset(geometry);
      std::copy(costmap.obstacles().begin(), costmap.obstacles().end(), anew.obstacles().begin());
      std::copy(costmap.unknown().begin(), costmap.unknown().end(), anew.unknown().begin());
      anew.update();
      ASSERT_EQ(costmap.costs(), anew.costs()) << "trial " << trial << ", round " << round;
      ASSERT_TRUE(std::ranges::equal(costmap.distances().squared_cells(),
                                     anew.distances().squared_cells()));
    }
  }
}

TEST(ToOccupancy, IsInPercentAsMapViewersExpect) {
  Grid<Cost> costs({6, 1, 0.1, {0.0, 0.0}}, kFreeCost);
  costs.cells = {kFreeCost, 1, kMaxRestrictedCost, kInscribedCost, kLethalCost, kUnknownCost};
  const OccupancyGrid grid = to_occupancy(costs);
  EXPECT_EQ(grid.cells, (std::vector<std::int8_t>{0, 1, 98, 99, 100, -1}));
}

}  // namespace
}  // namespace coop
