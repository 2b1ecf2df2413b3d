#include "global_planner/animal_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/global_planner/drawn_map.hpp"

namespace coop::global_planner {
namespace {

using test::kRobotFootprint;

Detection pig(double x, double y, double diameter = 0.4) {
  Detection detection;
  detection.class_id = "pig";
  detection.position = {x, y, 0.2};
  detection.size = {diameter, diameter, 0.4};
  return detection;
}

class AnimalLayerTest : public ::testing::Test {
 protected:
  void see(double seconds, const std::vector<Detection>& animals) {
    EXPECT_TRUE(layer_.see(animals, time_from_seconds(seconds)));
  }
  /// A pig walks along x at 0.5 m/s for two seconds and is at (2, 1) then, seen five times a
  /// second.
  void let_walk() {
    for (int i = 0; i <= 10; ++i) see(0.2 * i, {pig(1.0 + 0.1 * i, 1.0)});
  }
  bool covers(double x, double y, double now, const std::optional<Pose2>& robot = std::nullopt) {
    std::vector<std::size_t> cells;
    layer_.cover(grid_, time_from_seconds(now), robot, Footprint(kRobotFootprint), cells);
    return std::ranges::find(cells, grid_.index(grid_.cell_of({x, y}))) != cells.end();
  }
  AnimalLayer layer_{AnimalLayerConfig{}};
  GridGeometry grid_{.width = 80, .height = 40, .resolution = 0.05, .origin = {0.0, 0.0}};
};

TEST_F(AnimalLayerTest, EstimatesTheVelocityOfAnAnimalFromItsSightings) {
  let_walk();
  ASSERT_EQ(layer_.animals().size(), 1U);
  EXPECT_NEAR(layer_.animals()[0].velocity_in_map.x(), 0.5, 0.01);
  EXPECT_NEAR(layer_.animals()[0].velocity_in_map.y(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(layer_.animals()[0].radius, 0.2);
}

TEST_F(AnimalLayerTest, CoversWhereTheAnimalIsAndWhereItIsAboutToGoButNotWhereItWas) {
  let_walk();
  EXPECT_TRUE(covers(2.0, 1.0, 2.0));
  EXPECT_TRUE(covers(2.6, 1.0, 2.0));  // at the horizon of 1 s it is at 2.5, 0.2 + 0.1 m wide
  EXPECT_FALSE(covers(2.9, 1.0, 2.0));
  EXPECT_FALSE(covers(1.7, 1.0, 2.0));
  EXPECT_TRUE(covers(2.9, 1.0, 2.5));  // not seen for half a second it has gone on
}

TEST_F(AnimalLayerTest, AnAnimalThatIsNotSeenAnyMoreIsForgotten) {
  let_walk();
  EXPECT_TRUE(covers(2.4, 1.0, 3.0));
  EXPECT_FALSE(covers(2.5, 1.0, 3.1));
  see(3.2, {});
  EXPECT_TRUE(layer_.animals().empty());
}

TEST_F(AnimalLayerTest, KeepsAnimalsThatWalkSideBySideApart) {
  for (int i = 0; i <= 10; ++i) {
    see(0.2 * i, {pig(1.0 + 0.1 * i, 1.3), pig(3.0 - 0.1 * i, 0.7)});
  }
  ASSERT_EQ(layer_.animals().size(), 2U);
  EXPECT_NEAR(layer_.animals()[0].velocity_in_map.x(), 0.5, 0.01);
  EXPECT_NEAR(layer_.animals()[1].velocity_in_map.x(), -0.5, 0.01);
}

TEST_F(AnimalLayerTest, NothingIsCoveredUnderTheRobot) {
  let_walk();
  EXPECT_FALSE(covers(2.4, 1.0, 2.0, Pose2{2.4, 1.0, 0.0}));
  EXPECT_TRUE(covers(2.0, 1.0, 2.0, Pose2{2.4, 1.0, 0.0}));
}

TEST_F(AnimalLayerTest, ListsOutOfOrderAndAnimalsBeyondTheGridDoNoHarm) {
  let_walk();
  see(1.0, {pig(0.5, 0.5)});
  ASSERT_EQ(layer_.animals().size(), 1U);
  EXPECT_DOUBLE_EQ(layer_.animals()[0].center_in_map.x(), 2.0);
  see(2.2, {pig(-50.0, 80.0), pig(4.0, 2.0)});
  EXPECT_TRUE(covers(3.98, 1.98, 2.2));
}

}  // namespace
}  // namespace coop::global_planner
