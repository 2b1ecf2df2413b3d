// The pig pen as it is committed: its maps, its heaps and pigs, its robot.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/config/config.hpp"
#include "core/map/map_file.hpp"
#include "experiments/worlds/pig_house.hpp"
#include "simulator/contact.hpp"
#include "simulator/placement.hpp"
#include "simulator/simulation.hpp"
#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

const std::filesystem::path kSource = COOP_SOURCE_DIR;

std::filesystem::path map_of(int pen) {
  return kSource / ("maps/pig_pen_" + std::to_string(pen) + ".yaml");
}

class PigPen : public testing::Test {
 protected:
  [[nodiscard]] world::World world(std::uint64_t seed, int pen = 1) const {
    return build_world(description_, map::load_map(map_of(pen)), robot_, seed);
  }

  WorldDescription description_ =
      config::Document::load(kSource / "maps/pig_pen.world.yaml").read<WorldDescription>();
  RobotShape robot_ = shape_of(robot::RobotModel::load(kSource / "config/robot/pen_cleaner.urdf"));
};

TEST_F(PigPen, TheCommittedMapsAreTheDrawings) {
  for (int pen = 1; pen <= worlds::kPens; ++pen) {
    EXPECT_EQ(map::load_map(map_of(pen)), worlds::pig_house(pen)) << pen;
  }
}

TEST_F(PigPen, EveryPenIsFiveByThreeMetresAndClosed) {
  for (int pen = 1; pen <= worlds::kPens; ++pen) {
    const OccupancyGrid house = worlds::pig_house(pen);
    const auto at = [&](double x, double y) { return house[house.geometry.cell_of({x, y})]; };
    for (double x = -0.025; x < 5.05; x += 0.05) {
      EXPECT_EQ(at(x, -0.025), kOccupied);
      EXPECT_EQ(at(x, 3.025), kOccupied);
    }
    for (double y = -0.025; y < 3.05; y += 0.05) {
      EXPECT_EQ(at(-0.025, y), kOccupied);
      EXPECT_EQ(at(5.025, y), kOccupied);
    }
    int free = 0;
    for (double x = 0.025; x < 5.0; x += 0.05) {
      for (double y = 0.025; y < 3.0; y += 0.05) free += at(x, y) == kFree ? 1 : 0;
    }
    EXPECT_EQ(free, 100 * 60);
  }
}

TEST_F(PigPen, HeapsAndPigsOfEverySeedLieAndStandApartInThePen) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const world::World pen = world(seed);
    const auto pigs = place_animals(description_, pen, robot_);
    ASSERT_EQ(pen.heaps.size(), 5U);
    ASSERT_EQ(pigs.size(), 3U);
    for (const world::Heap& heap : pen.heaps) {
      EXPECT_TRUE(disc_is_free(heap.position, heap.radius + 0.2, pen.grid));
      for (const world::Heap& other : pen.heaps) {
        EXPECT_TRUE(&other == &heap || (other.position - heap.position).norm() >= 0.5);
      }
    }
    for (const AnimalDescription& pig : pigs) {
      EXPECT_TRUE(disc_is_free({pig.x, pig.y}, pig.radius, pen.grid));
      EXPECT_TRUE(pig.x > 0 && pig.x < 5 && pig.y > 0 && pig.y < 3);
    }
  }
}

TEST_F(PigPen, ItsRobotHasABladeAsWideAsItselfAndTurnsWithinHalfAPen) {
  EXPECT_NEAR(robot_.scraper.center().x(), 0.41, 1e-9);
  EXPECT_NEAR(robot_.scraper.sizes().y(), 0.42, 1e-9);
  const double radius = robot_.base.min_turning_radius();
  EXPECT_NEAR(radius, 0.395, 0.002);
  double outer = 0.0;
  for (const Eigen::Vector2d& corner : robot_.footprint) {
    outer = std::max(outer, (corner - Eigen::Vector2d(0.0, -radius)).norm());
  }
  EXPECT_LT(2.0 * outer, 1.6);
}

TEST_F(PigPen, ARobotThatDrivesIntoAPigCountsItAsACollisionWithAnAnimal) {
  world::World pen = world(1);
  pen.robot_start = {1.0, 1.5, 0.0};
  SimulationConfig config = test::ideal();
  Simulation simulation(config, robot_, pen, {{"pig", 2.2, 1.5, 0.25, 0.0}});
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(simulation.gate().accept({0.4, 0.0}, simulation.now()));
    simulation.step();
  }
  EXPECT_EQ(simulation.ground_truth().animal_collision_count, 1U);
  EXPECT_EQ(simulation.ground_truth().collision_count, 1U);
  EXPECT_NEAR(simulation.ground_truth().robot_in_world.x, 2.2 - 0.25 - 0.44, 0.02);
}

TEST_F(PigPen, WhatWasCleanedStaysCleanedWhenTheSimulationGoesOnFromItsJournal) {
  world::World pen = world(1);
  pen.robot_start = {1.0, 1.5, 0.0};
  pen.heaps = {{"heap", {1.8, 1.5}, 0.07, world::HeapState::kOnFloor}};
  Simulation simulation(test::ideal(), robot_, pen, {});
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(simulation.gate().accept({0.4, 0.0}, simulation.now()));
    simulation.step();
  }
  ASSERT_EQ(simulation.ground_truth().heaps[0].state, world::HeapState::kCleaned);
  std::string stored;
  simulation.store(stored);
  Simulation restarted(test::ideal(), robot_, pen, {});
  ASSERT_EQ(restarted.ground_truth().heaps[0].state, world::HeapState::kOnFloor);
  restarted.restore(stored);
  EXPECT_EQ(restarted.ground_truth().heaps, simulation.ground_truth().heaps);
}

}  // namespace
}  // namespace coop::simulator
