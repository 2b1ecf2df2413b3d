#include "simulator/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

/// One occupied cell: the square from (2, 1) to (3, 2), and an unknown one above it.
const OccupancyGrid& one_block() {
  static const OccupancyGrid grid = test::draw({".....",   //
                                                "..?..",   //
                                                "..#..",   //
                                                "....."},  //
                                               1.0);
  return grid;
}

bool hits(std::vector<Vector2d> outline, const Pose2& pose) {
  std::vector<Vector2d> placed;
  place(outline, pose, placed);
  return outline_hits_grid(placed, one_block());
}

const std::vector<Vector2d> kUnitSquare = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};

TEST(Contact, AnOutlineBesideABlockTouchesNothingUntilItOverlaps) {
  EXPECT_FALSE(hits(kUnitSquare, {1.5, 1.5, 0}));  // flush with its left face
  EXPECT_TRUE(hits(kUnitSquare, {1.51, 1.5, 0}));
  EXPECT_FALSE(hits(kUnitSquare, {2.5, 0.5, 0}));
  EXPECT_TRUE(hits(kUnitSquare, {2.5, 0.51, 0}));
}

TEST(Contact, ATurnedOutlineReachesWithItsCorner) {
  const double reach = std::sqrt(0.5);  // of the corner, turned by 45 degrees
  EXPECT_FALSE(hits(kUnitSquare, {2.0 - reach - 0.01, 1.5, kPi / 4}));
  EXPECT_TRUE(hits(kUnitSquare, {2.0 - reach + 0.01, 1.5, kPi / 4}));
}

TEST(Contact, AnEdgePassesTheCornerOfABlockAtItsTrueDistance) {
  // The square turned by 45 degrees, off the block's corner (2, 1) along the diagonal: contact at
  // half its side.
  const double off = 0.5 / std::numbers::sqrt2;
  EXPECT_FALSE(hits(kUnitSquare, {2.0 - off - 0.005, 1.0 - off - 0.005, kPi / 4}));
  EXPECT_TRUE(hits(kUnitSquare, {2.0 - off + 0.005, 1.0 - off + 0.005, kPi / 4}));
}

TEST(Contact, ABlockWithinTheOutlineIsFound) {
  const std::vector<Vector2d> large = {{-2, -1.4}, {2, -1.4}, {2, 1.4}, {-2, 1.4}};
  EXPECT_TRUE(hits(large, {2.5, 1.5, 0.3}));
}

TEST(Contact, UnknownCellsStopNobody) {
  EXPECT_FALSE(hits(kUnitSquare, {2.5, 2.6, 0}));
}

TEST(Contact, DistanceToAnOutline) {
  EXPECT_DOUBLE_EQ(distance_to_outline(kUnitSquare, {1.5, 0.2}), 1.0);
  EXPECT_DOUBLE_EQ(distance_to_outline(kUnitSquare, {3.5, 4.5}), 5.0);
  EXPECT_EQ(distance_to_outline(kUnitSquare, {0.1, -0.4}), 0.0);
}

TEST(Contact, ADiscTouchesTheNearestPointOfABlock) {
  EXPECT_FALSE(disc_hits_grid({1.4, 1.5}, 0.59, one_block()));
  EXPECT_TRUE(disc_hits_grid({1.4, 1.5}, 0.61, one_block()));
  EXPECT_FALSE(disc_hits_grid({1.7, 0.6}, 0.49, one_block()));  // the corner is 0.5 away
  EXPECT_TRUE(disc_hits_grid({1.7, 0.6}, 0.51, one_block()));
}

TEST(Contact, FreeFloorIsNeitherUnknownNorBeyondTheBorder) {
  EXPECT_TRUE(disc_is_free({1.0, 1.0}, 0.9, one_block()));
  EXPECT_FALSE(disc_is_free({2.5, 3.4}, 0.5, one_block()));  // the unknown cell
  EXPECT_FALSE(disc_is_free({0.4, 1.0}, 0.5, one_block()));  // the border
}

}  // namespace
}  // namespace coop::simulator
