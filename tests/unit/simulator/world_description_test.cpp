#include "simulator/world_description.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "core/config/config.hpp"
#include "core/map/map_file.hpp"
#include "core/world/shapes.hpp"
#include "experiments/worlds/duck_house.hpp"
#include "simulator/contact.hpp"
#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::filesystem::path kMaps = std::filesystem::path(COOP_SOURCE_DIR) / "maps";

WorldDescription described(const std::string& yaml) {
  return config::Document::parse(yaml, "test.world.yaml").read<WorldDescription>();
}

world::World build(const std::string& yaml, std::uint64_t seed = 1) {
  return build_world(described("map: room.yaml\nrobot_start: {x: 1, y: 1.5}\n" + yaml),
                     test::room(4.0, 3.0), test::robot(), seed);
}

TEST(WorldDescription, ReadsAWholeFile) {
  const WorldDescription world = described(R"(
map: barn.yaml
robot_start: {x: 1, y: 2, yaw: 0.5}
eggs: [{id: blue, x: 3, y: 4}, {x: 5, y: 6}]
random_eggs: {count: 2, region: [0, 0, 5, 5]}
walls: [{x1: 0, y1: 1, x2: 2, y2: 3, thickness: 0.2}]
boxes: [{x_min: 0, y_min: 1, x_max: 2, y_max: 3}]
animals: [{x: 2, y: 2, speed: 0.5}]
)");
  EXPECT_EQ(world.map, "barn.yaml");
  EXPECT_EQ(world.robot_start.yaw, 0.5);
  ASSERT_EQ(world.eggs.size(), 2U);
  EXPECT_EQ(world.eggs[0].id, "blue");
  EXPECT_EQ(world.random_eggs.count, 2);
  EXPECT_EQ(world.walls.at(0).thickness, 0.2);
  EXPECT_EQ(world.animals.at(0).speed, 0.5);
}

TEST(WorldDescription, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT([] { (void)described("eggs: []"); },
              ThrowsMessage<config::Error>(HasSubstr("'map' is missing")));
  EXPECT_THAT([] { (void)described("map: a.yaml\nrobot_strat: {x: 1}"); },
              ThrowsMessage<config::Error>(HasSubstr("robot_start")));
  EXPECT_THAT([] { (void)described("map: a.yaml\nrandom_eggs: {region: [1, 2, 0, 3]}"); },
              ThrowsMessage<config::Error>(HasSubstr("region")));
}

TEST(WorldDescription, EggsLieOnTheFloorUnderTheirNames) {
  const world::World world = build("eggs: [{id: blue, x: 3, y: 2}, {x: 2.5, y: 1}]");
  ASSERT_EQ(world.eggs.size(), 2U);
  EXPECT_EQ(world.eggs[0].id, "blue");
  EXPECT_EQ(world.eggs[1].id, "egg_2");
  EXPECT_EQ(world.eggs[1].position, Eigen::Vector3d(2.5, 1, world::kEggHalfWidth));
}

TEST(WorldDescription, WallsAndBoxesBecomePartOfTheMap) {
  const world::World world = build(
      "walls: [{x1: 2.5, y1: 0.5, x2: 2.5, y2: 2.0, thickness: 0.1}]\n"
      "boxes: [{x_min: 3.0, y_min: 1.0, x_max: 3.5, y_max: 1.5}]");
  const auto at = [&](double x, double y) {
    return world.grid[world.grid.geometry.cell_of({x, y})];
  };
  EXPECT_EQ(at(2.48, 1.0), kOccupied);
  EXPECT_EQ(at(2.52, 1.0), kOccupied);
  EXPECT_EQ(at(2.62, 1.0), kFree);
  EXPECT_EQ(at(2.5, 2.2), kFree);
  EXPECT_EQ(at(3.02, 1.02), kOccupied);
  EXPECT_EQ(at(3.48, 1.48), kOccupied);
  EXPECT_EQ(at(3.52, 1.2), kFree);
}

TEST(WorldDescription, AThinSlantedWallHasNoHoles) {
  const world::World world =
      build("walls: [{x1: 2.0, y1: 0.3, x2: 3.5, y2: 2.7, thickness: 0.01}]");
  for (double t = 0.0; t <= 1.0; t += 0.002) {
    EXPECT_TRUE(disc_hits_grid({2.0 + 1.5 * t, 0.3 + 2.4 * t}, 1e-6, world.grid)) << t;
  }
}

TEST(WorldDescription, RefusesWhatStandsInAWall) {
  EXPECT_THAT([] { build("boxes: [{x_min: 1.5, y_min: 1, x_max: 2, y_max: 2}]"); },
              ThrowsMessage<config::Error>(HasSubstr("robot's start")));
  EXPECT_THAT([] { build("eggs: [{x: 4.02, y: 1}]"); },
              ThrowsMessage<config::Error>(HasSubstr("egg at (4.02")));
  EXPECT_THAT([] { build("animals: [{x: 3.9, y: 1}]"); },
              ThrowsMessage<config::Error>(HasSubstr("animal at")));
  EXPECT_THAT([] { build("eggs: [{id: a, x: 2, y: 1}, {id: a, x: 3, y: 1}]"); },
              ThrowsMessage<config::Error>(HasSubstr("two eggs are called 'a'")));
}

TEST(WorldDescription, SaysWhenTheRandomEggsFindNoRoom) {
  EXPECT_THAT([] { build("random_eggs: {count: 30}"); },
              ThrowsMessage<config::Error>(HasSubstr("of 30 eggs only")));
}

TEST(WorldDescription, RandomEggsFollowTheSeedOfTheSimulationUnlessTheyHaveTheirOwn) {
  const std::string free = "random_eggs: {count: 2}";
  EXPECT_EQ(build(free, 4).eggs, build(free, 4).eggs);
  EXPECT_NE(build(free, 4).eggs, build(free, 5).eggs);
  const std::string own = "random_eggs: {count: 2, seed: 9}";
  EXPECT_EQ(build(own, 4).eggs, build(own, 5).eggs);
}

class DuckHouse : public testing::Test {
 protected:
  [[nodiscard]] world::World world(std::uint64_t seed) const {
    return build_world(description_, map::load_map(kMaps / description_.map), robot_, seed);
  }

  WorldDescription description_ =
      config::Document::load(kMaps / "duck_house.world.yaml").read<WorldDescription>();
  RobotShape robot_ = shape_of(robot::RobotModel::load(std::filesystem::path(COOP_SOURCE_DIR) /
                                                       "config/robot/egg_collector.urdf"));
};

TEST_F(DuckHouse, TheCommittedMapIsTheDrawing) {
  EXPECT_EQ(map::load_map(kMaps / "duck_house.yaml"), worlds::duck_house());
}

TEST_F(DuckHouse, EggsOfEverySeedCanBePicked) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const world::World house = world(seed);
    ASSERT_EQ(house.eggs.size(), 5U) << seed;
    for (std::size_t i = 0; i < house.eggs.size(); ++i) {
      const Eigen::Vector2d egg = house.eggs[i].position.head<2>();
      EXPECT_TRUE(disc_is_free(egg, 0.45, house.grid)) << seed;
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_GE((egg - house.eggs[j].position.head<2>()).norm(), 0.6) << seed;
      }
      bool can_stand = false;
      std::vector<Eigen::Vector2d> outline;
      for (int k = 0; k < 24; ++k) {
        const Pose2 egg_pose{egg.x(), egg.y(), 2 * std::numbers::pi * k / 24};
        place(robot_.footprint, egg_pose * Pose2{-robot_.working_point.x(), 0, 0}, outline);
        can_stand = can_stand || !outline_hits_grid(outline, house.grid);
      }
      EXPECT_TRUE(can_stand) << seed;
    }
  }
}

TEST_F(DuckHouse, TheRobotOfTheFilesHasTheShapeTheSimulationNeeds) {
  EXPECT_EQ(robot_.footprint.size(), 4U);
  ASSERT_EQ(robot_.wheels.size(), 4U);
  int steered = 0;
  for (const WheelPatch& wheel : robot_.wheels) {
    steered += wheel.steered ? 1 : 0;
    EXPECT_NEAR(std::abs(wheel.center.y()), 0.5 * robot_.base.track, 1e-9);
    EXPECT_NEAR(wheel.center.x(), wheel.steered ? robot_.base.wheelbase : 0.0, 1e-9);
  }
  EXPECT_EQ(steered, 2);
  // The cup lets go at the basket's frame.
  const auto model = robot::RobotModel::load(std::filesystem::path(COOP_SOURCE_DIR) /
                                             "config/robot/egg_collector.urdf");
  EXPECT_TRUE(
      robot_.basket.contains(Eigen::Vector3d(model.mount(robot::kBasketLink).translation())));
}

}  // namespace
}  // namespace coop::simulator
