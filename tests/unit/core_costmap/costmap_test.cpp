#include "core/costmap/costmap.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(ToOccupancy, IsInPercentAsMapViewersExpect) {
  Grid<Cost> costs({6, 1, 0.1, {0.0, 0.0}}, kFreeCost);
  costs.cells = {kFreeCost, 1, kMaxRestrictedCost, kInscribedCost, kLethalCost, kUnknownCost};
  const OccupancyGrid grid = to_occupancy(costs);
  EXPECT_EQ(grid.cells, (std::vector<std::int8_t>{0, 1, 98, 99, 100, -1}));
}

}  // namespace
}  // namespace coop
