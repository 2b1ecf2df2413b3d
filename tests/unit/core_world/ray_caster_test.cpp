#include "core/world/ray_caster.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"

namespace coop::world {
namespace {

using Eigen::Vector2d;

/// A grid drawn as text, first line on top: '#' occupied, '.' free, '?' unknown.
OccupancyGrid draw(const std::vector<std::string>& lines, double resolution, Vector2d origin) {
  const int height = static_cast<int>(lines.size());
  const int width = static_cast<int>(lines.front().size());
  OccupancyGrid grid({width, height, resolution, origin}, kFree);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = lines[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      grid[{x, y}] = c == '#' ? kOccupied : c == '?' ? kUnknown : kFree;
    }
  }
  return grid;
}

Vector2d along(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle)};
}

/// Cells of half a metre from x = -1, y = 2 on; the box's near faces are at x = 0.5 and y = 3.5.
const OccupancyGrid& room() {
  static const OccupancyGrid grid = draw({"########",   //
                                          "#......#",   // y 4.0 .. 4.5
                                          "#..##..#",   // y 3.5 .. 4.0, box at x 0.5 .. 1.5
                                          "#......#",   //
                                          "#..?...#",   // unknown at x 0.5 .. 1.0, y 2.5 .. 3.0
                                          "########"},  //
                                         0.5, {-1.0, 2.0});
  return grid;
}

TEST(RayCaster, MeasuresToTheFaceOfAWallAlongTheAxes) {
  const RayCaster caster(room());
  const Vector2d origin(0.2, 3.2);
  EXPECT_DOUBLE_EQ(caster.cast(origin, {1, 0}, 10)->range, 2.3);     // east wall from x = 2.5
  EXPECT_DOUBLE_EQ(caster.cast(origin, {-1, 0}, 10)->range, 0.7);    // west wall up to x = -0.5
  EXPECT_DOUBLE_EQ(caster.cast(origin, {0, 1}, 10)->range, 1.3);     // north wall from y = 4.5
  EXPECT_NEAR(caster.cast(origin, {0, -1}, 10)->range, 0.7, 1e-12);  // south wall up to y = 2.5
}

TEST(RayCaster, MeasuresToABoxAtAnAngle) {
  const RayCaster caster(room());
  const auto low =
      caster.cast({0.2, 3.1}, along(45), 10);  // at y = 3.5 it is at x = 0.6: bottom face
  EXPECT_NEAR(low->range, 0.4 * std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(low->cell, (Cell{3, 3}));
  EXPECT_FALSE(low->vertical_face);
  const auto side =
      caster.cast({0.2, 3.3}, along(45), 10);  // at x = 0.5 it is at y = 3.6: left face
  EXPECT_NEAR(side->range, 0.3 * std::numbers::sqrt2, 1e-12);
  EXPECT_TRUE(side->vertical_face);
}

TEST(RayCaster, UnknownCellsLetTheRayPass) {
  const RayCaster caster(room());
  EXPECT_DOUBLE_EQ(caster.cast({0.2, 2.7}, {1, 0}, 10)->range, 2.3);
}

TEST(RayCaster, SeesNothingBeyondItsRange) {
  const RayCaster caster(room());
  EXPECT_FALSE(caster.cast({0.2, 3.2}, {1, 0}, 2.29).has_value());
  EXPECT_TRUE(caster.cast({0.2, 3.2}, {1, 0}, 2.31).has_value());
}

TEST(RayCaster, AnOriginInsideAnObstacleIsAtRangeZero) {
  const RayCaster caster(room());
  EXPECT_EQ(caster.cast({1.0, 3.7}, along(30), 10)->range, 0.0);
}

TEST(RayCaster, ARayFromOutsideMeetsTheOuterFace) {
  const RayCaster caster(room());
  const auto hit = caster.cast({-3.0, 3.2}, {1, 0}, 10);
  EXPECT_DOUBLE_EQ(hit->range, 2.0);
  EXPECT_TRUE(hit->vertical_face);
  EXPECT_DOUBLE_EQ(caster.cast({0.0, 7.0}, {0, -1}, 10)->range, 2.0);
  EXPECT_FALSE(caster.cast({-3.0, 3.2}, {-1, 0}, 10).has_value());
  EXPECT_FALSE(caster.cast({-3.0, 9.0}, {1, 0}, 10).has_value());
}

TEST(RayCaster, LeavesAnOpenGridWithoutAHit) {
  const RayCaster caster(OccupancyGrid({4, 4, 0.5, {0, 0}}, kFree));
  for (int degrees = 0; degrees < 360; degrees += 7) {
    EXPECT_FALSE(caster.cast({1.1, 0.9}, along(degrees), 100).has_value()) << degrees;
  }
}

/// Marches in steps of a hundredth of a cell: slow, coarse and obviously right.
double march(const RayCaster& caster, const Vector2d& origin, const Vector2d& direction) {
  const double step = 0.01 * caster.geometry().resolution;
  for (int i = 0; i < 3000; ++i) {
    if (caster.occupied(caster.geometry().cell_of(origin + i * step * direction))) return i * step;
  }
  return 30.0 * caster.geometry().resolution;
}

TEST(RayCaster, AgreesWithMarchingInRandomWorlds) {
  RandomStream random(7, "ray_caster_test");
  for (int trial = 0; trial < 2000; ++trial) {
    OccupancyGrid grid({12, 9, 0.25, {-0.7, 0.3}}, kFree);
    for (auto& cell : grid.cells) cell = random.below(12) == 0 ? kOccupied : kFree;
    const RayCaster caster(grid);
    const Vector2d origin(random.uniform(-0.7, 2.3), random.uniform(0.3, 2.5));
    const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const double marched = march(caster, origin, direction);
    const auto hit = caster.cast(origin, direction, 7.5);
    const double range = hit ? hit->range : 7.5;
    // Marching may step over a corner that the ray cuts by less than a step: then the exact ray is
    // the shorter.
    EXPECT_LE(range, marched + 1e-9);
    if (hit && marched - range > 0.003) {
      const Vector2d inside = origin + (range + 1e-7) * direction;
      EXPECT_TRUE(caster.occupied(caster.geometry().cell_of(inside)));
    }
  }
}

TEST(IntersectDisc, MeasuresToTheNearSide) {
  EXPECT_DOUBLE_EQ(*intersect_disc({0, 0}, {1, 0}, {3, 0}, 0.5), 2.5);
  EXPECT_NEAR(*intersect_disc({0, 0}, {1, 0}, {3, 0.3}, 0.5), 3 - 0.4, 1e-12);
}

TEST(IntersectDisc, MissesBesideAndBehind) {
  EXPECT_FALSE(intersect_disc({0, 0}, {1, 0}, {3, 0.6}, 0.5).has_value());
  EXPECT_FALSE(intersect_disc({0, 0}, {1, 0}, {-3, 0}, 0.5).has_value());
}

TEST(IntersectDisc, IsZeroFromWithin) {
  EXPECT_EQ(*intersect_disc({0, 0}, {1, 0}, {0.1, 0}, 0.5), 0.0);
}

}  // namespace
}  // namespace coop::world
