#include "simulator/flock.hpp"

#include <gtest/gtest.h>

#include "simulator/contact.hpp"
#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;

AnimalDescription animal(const std::string& id, double x, double y) {
  return {.id = id, .x = x, .y = y, .radius = 0.15, .speed = 0.3};
}

/// The robot's outline somewhere.
std::vector<Vector2d> robot_at(const Pose2& pose) {
  std::vector<Vector2d> outline;
  place(test::robot().footprint, pose, outline);
  return outline;
}

const Pose2 kFarAway{50, 50, 0};

TEST(Flock, AnimalsWalkAndKeepOffWallsAndEachOther) {
  const OccupancyGrid grid = test::room(3.0, 2.0);
  Flock flock({}, {animal("a", 0.5, 0.5), animal("b", 1.5, 1.0), animal("c", 2.4, 1.5)}, 5);
  const auto outline = robot_at(kFarAway);
  double travelled = 0.0;
  for (int i = 0; i < 60000; ++i) {  // ten minutes
    const Vector2d before = flock.animals()[0].position;
    flock.step(0.01, grid, outline);
    travelled += (flock.animals()[0].position - before).norm();
    for (std::size_t a = 0; a < 3; ++a) {
      ASSERT_FALSE(disc_hits_grid(flock.animals()[a].position, 0.15, grid));
      for (std::size_t b = a + 1; b < 3; ++b) {
        const double apart = (flock.animals()[a].position - flock.animals()[b].position).norm();
        ASSERT_GE(apart, 0.30 - 1e-9);
      }
    }
  }
  EXPECT_GT(travelled, 30.0);
  EXPECT_LE(travelled, 0.3 * 600 + 1e-6);
}

TEST(Flock, ShyAnimalsStandStillBeforeTheRobot) {
  const OccupancyGrid grid = test::room(3.0, 2.0);
  FlockConfig config;
  config.robot_clearance = 0.4;
  Flock flock(config, {animal("a", 0.5, 0.5)}, 5);
  const auto outline = robot_at({1.8, 1.0, 0.0});
  for (int i = 0; i < 30000; ++i) {
    flock.step(0.01, grid, outline);
    ASSERT_GE(distance_to_outline(outline, flock.animals()[0].position), 0.15 + 0.4 - 1e-9);
  }
}

TEST(Flock, AnAnimalTooNearMayGoAwayButNotCloser) {
  const OccupancyGrid grid = test::room(6.0, 4.0);
  Flock flock({}, {animal("a", 2.0, 2.5)}, 9);
  const auto outline = robot_at({1.8, 2.0, 0.0});  // its side is 0.25 m away
  double distance = distance_to_outline(outline, flock.animals()[0].position);
  for (int i = 0; i < 60000 && distance < 0.55; ++i) {
    flock.step(0.01, grid, outline);
    const double now = distance_to_outline(outline, flock.animals()[0].position);
    ASSERT_GE(now, distance - 1e-12);
    distance = now;
  }
  EXPECT_GE(distance, 0.55);
}

TEST(Flock, OneAnimalsWaysDoNotDependOnTheOthersNumbers) {
  const OccupancyGrid grid = test::room(20.0, 20.0);
  Flock alone({}, {animal("a", 3, 3)}, 5);
  Flock together({}, {animal("z", 17, 17), animal("a", 3, 3)}, 5);
  const auto outline = robot_at(kFarAway);
  for (int i = 0; i < 500; ++i) {
    alone.step(0.01, grid, outline);
    together.step(0.01, grid, outline);
  }
  EXPECT_EQ(alone.animals()[0].position, together.animals()[1].position);
}

}  // namespace
}  // namespace coop::simulator
