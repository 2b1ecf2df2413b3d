#include "simulator/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/world/shapes.hpp"
#include "simulator/contact.hpp"
#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

constexpr Twist2 kForward{0.5, 0.0};

Simulation ideal_in(const world::World& world) {
  return {test::ideal(), test::robot(), world, {}};
}

void drive(Simulation& simulation, int ticks, const Twist2& command) {
  for (int i = 0; i < ticks; ++i) {
    simulation.gate().accept(command, simulation.now());
    simulation.step();
  }
}

/// A varied drive, the same for everybody.
Twist2 winding(int tick) {
  return {0.4 + 0.1 * std::sin(0.01 * tick), 0.5 * std::sin(0.004 * tick)};
}

/// Everything that can be seen from outside, as bytes would be compared: exactly.
void expect_same(const Simulation& a, const Simulation& b) {
  ASSERT_EQ(a.now(), b.now());
  EXPECT_EQ(a.ground_truth().robot_in_world, b.ground_truth().robot_in_world);
  EXPECT_EQ(a.ground_truth().velocity, b.ground_truth().velocity);
  EXPECT_EQ(a.ground_truth().steering_angle, b.ground_truth().steering_angle);
  EXPECT_EQ(a.ground_truth().collision_count, b.ground_truth().collision_count);
  EXPECT_EQ(a.ground_truth().eggs, b.ground_truth().eggs);
  EXPECT_EQ(a.ground_truth().animals, b.ground_truth().animals);
  EXPECT_EQ(a.odometry().odometry().base_in_odom, b.odometry().odometry().base_in_odom);
  EXPECT_EQ(a.odometry().covariance(), b.odometry().covariance());
  EXPECT_EQ(a.imu().angular_velocity, b.imu().angular_velocity);
  EXPECT_EQ(a.imu().linear_acceleration, b.imu().linear_acceleration);
}

const std::vector<AnimalDescription> kAnimals = {{.id = "a", .x = 2, .y = 6},
                                                 {.id = "b", .x = 7, .y = 2}};

Simulation full(std::uint64_t seed) {
  world::World world = test::world_in(test::room(10, 8), {2, 2, 0.3}, seed);
  world.eggs = {{"e", {5, 5, world::kEggHalfWidth}, world::EggState::kOnFloor}};
  return {SimulationConfig{}, test::robot(), world, kAnimals};
}

TEST(Simulation, StandsStillAndTimePassesWithoutCommands) {
  Simulation simulation = ideal_in(test::world_in(test::room(4, 3), {1, 1.5, 0.2}));
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_EQ(simulation.now(), Simulation::kStart + std::chrono::seconds(1));
  EXPECT_EQ(simulation.ground_truth().robot_in_world, (Pose2{1, 1.5, 0.2}));
  EXPECT_EQ(simulation.setpoint().cause, vehicle::DriveCause::kNoCommand);
}

TEST(Simulation, AnIdealRobotIsWhereItsOdometrySays) {
  Simulation simulation = ideal_in(test::world_in(test::room(10, 8), {3, 3, 0.5}));
  for (int i = 0; i < 600; ++i) {
    simulation.gate().accept({0.4, 0.3}, simulation.now());
    simulation.step();
  }
  const Pose2 odometry = simulation.odometry().odometry().base_in_odom;
  const Pose2 truth = Pose2{3, 3, 0.5}.inverse() * simulation.ground_truth().robot_in_world;
  EXPECT_NEAR(odometry.x, truth.x, 0.002);  // encoders count half millimetres
  EXPECT_NEAR(odometry.y, truth.y, 0.002);
  EXPECT_NEAR(angle_difference(odometry.yaw, truth.yaw), 0.0, 0.002);
  EXPECT_EQ(simulation.odometry().odometry().stamp, simulation.now());
}

TEST(Simulation, OdometryOfTheRealisticRobotDriftsByPerCentsNotMore) {
  Simulation simulation = full(3);
  double way = 0.0;
  for (int i = 0; i < 3000; ++i) {
    simulation.gate().accept({0.4, 0.45}, simulation.now());  // round and round
    simulation.step();
    way += simulation.ground_truth().velocity.v * 0.01;
  }
  const Pose2 truth = Pose2{2, 2, 0.3}.inverse() * simulation.ground_truth().robot_in_world;
  const double error = distance(simulation.odometry().odometry().base_in_odom, truth);
  EXPECT_GT(way, 10.0);
  EXPECT_GT(error, 0.005);
  EXPECT_LT(error, 0.05 * way);
}

TEST(Simulation, TheWatchdogStopsARobotWhoseCommandsCease) {
  Simulation simulation = ideal_in(test::world_in(test::room(10, 3), {1, 1.5, 0}));
  drive(simulation, 200, kForward);
  EXPECT_DOUBLE_EQ(simulation.ground_truth().velocity.v, 0.5);
  for (int i = 0; i < 29; ++i) simulation.step();
  EXPECT_DOUBLE_EQ(simulation.ground_truth().velocity.v, 0.5);
  for (int i = 0; i < 35; ++i) simulation.step();  // 0.5 m/s at 1.5 m/s^2: 34 ticks
  EXPECT_EQ(simulation.ground_truth().velocity.v, 0.0);
  EXPECT_EQ(simulation.setpoint().cause, vehicle::DriveCause::kCommandStale);
}

TEST(Simulation, AnEmergencyStopHoldsTheRobotDespiteCommands) {
  Simulation simulation = ideal_in(test::world_in(test::room(10, 3), {1, 1.5, 0}));
  simulation.gate().emergency_stops().set("person", true, "button");
  drive(simulation, 100, kForward);
  EXPECT_EQ(simulation.ground_truth().robot_in_world, (Pose2{1, 1.5, 0}));
  simulation.gate().emergency_stops().set("person", false, "");
  drive(simulation, 100, kForward);
  EXPECT_GT(simulation.ground_truth().robot_in_world.x, 1.1);
}

TEST(Simulation, ARobotDrivenIntoAWallStopsAtContactAndTheCollisionCountsOnce) {
  // Nose 0.7 m ahead; the wall begins at x = 4.
  Simulation simulation = ideal_in(test::world_in(test::room(4, 3), {1, 1.5, 0}));
  drive(simulation, 1000, kForward);
  const auto& truth = simulation.ground_truth();
  EXPECT_LE(truth.robot_in_world.x, 3.3);
  EXPECT_GT(truth.robot_in_world.x, 3.3 - 0.006);  // one tick of way
  EXPECT_TRUE(truth.in_collision);
  EXPECT_EQ(truth.collision_count, 1U);
  // The wheels were blocked too: odometry does not run away.
  EXPECT_NEAR(simulation.odometry().odometry().base_in_odom.x, truth.robot_in_world.x - 1, 0.01);
}

TEST(Simulation, ARobotCanBackAwayFromAWallAndHitItAgain) {
  Simulation simulation = ideal_in(test::world_in(test::room(4, 3), {1, 1.5, 0}));
  drive(simulation, 1000, kForward);
  drive(simulation, 200, {-0.3, 0.0});
  EXPECT_FALSE(simulation.ground_truth().in_collision);
  EXPECT_LT(simulation.ground_truth().robot_in_world.x, 3.0);
  drive(simulation, 400, kForward);
  EXPECT_EQ(simulation.ground_truth().collision_count, 2U);
}

TEST(Simulation, AnimalsAreInTheWayAndAreNeverDrivenOver) {
  const world::World world = test::world_in(test::room(6, 3), {1, 1.5, 0});
  Simulation simulation(test::ideal(), test::robot(), world,
                        {{.id = "lazy", .x = 3.5, .y = 1.5, .radius = 0.15, .speed = 0.0}});
  drive(simulation, 1000, kForward);
  const auto& truth = simulation.ground_truth();
  EXPECT_EQ(truth.collision_count, 1U);
  EXPECT_LE(truth.robot_in_world.x, 3.5 - 0.15 - 0.7);
  EXPECT_GT(truth.robot_in_world.x, 3.5 - 0.15 - 0.7 - 0.006);
}

TEST(Simulation, TheSameSeedAndCommandsGiveTheSameStateToTheBit) {
  Simulation one = full(7);
  Simulation two = full(7);
  for (int i = 0; i < 4000; ++i) {
    for (Simulation* simulation : {&one, &two}) {
      simulation->gate().accept(winding(i), simulation->now());
      simulation->step();
    }
  }
  expect_same(one, two);
}

TEST(Simulation, AnotherSeedGivesAnotherRun) {
  Simulation one = full(7);
  Simulation two = full(8);
  for (int i = 0; i < 500; ++i) {
    for (Simulation* simulation : {&one, &two}) {
      simulation->gate().accept(winding(i), simulation->now());
      simulation->step();
    }
  }
  EXPECT_NE(one.ground_truth().robot_in_world, two.ground_truth().robot_in_world);
  EXPECT_NE(one.imu().angular_velocity, two.imu().angular_velocity);
  EXPECT_NE(one.ground_truth().animals, two.ground_truth().animals);
}

TEST(Simulation, AResumedRunIsTheUninterruptedRunToTheBit) {
  Simulation whole = full(7);
  Simulation first = full(7);
  std::string stored;
  for (int i = 0; i < 3000; ++i) {
    for (Simulation* simulation : {&whole, &first}) {
      if (simulation == &first && i >= 1501) continue;
      simulation->set_gripper({true, {0.85, 0.0, 0.4}});
      simulation->gate().accept(winding(i), simulation->now());
      simulation->step();
    }
    if (i == 1500) first.store(stored);
  }
  Simulation second = full(7);
  second.restore(stored);
  expect_same(first, second);
  for (int i = 1501; i < 3000; ++i) {
    second.gate().accept(winding(i), second.now());
    second.step();
  }
  expect_same(whole, second);
}

TEST(Simulation, TheStateOfAnotherWorldIsRefused) {
  std::string stored;
  full(7).store(stored);
  Simulation other = full(8);
  EXPECT_THROW(other.restore(stored), std::runtime_error);
  EXPECT_EQ(other.tick(), 0U);
}

TEST(Simulation, AnEggIsPickedCarriedAndCollected) {
  world::World world = test::world_in(test::room(6, 3), {1, 1.5, 0});
  world.eggs = {{"e", {1.85, 1.5, world::kEggHalfWidth}, world::EggState::kOnFloor}};
  Simulation simulation = ideal_in(world);
  simulation.set_gripper({true, {0.85, 0.0, 2 * world::kEggHalfWidth}});
  simulation.step();
  EXPECT_EQ(simulation.ground_truth().eggs[0].state, world::EggState::kInGripper);
  simulation.set_gripper({true, {0.0, 0.1, 0.4}});
  drive(simulation, 100, kForward);
  simulation.set_gripper({false, {0.0, 0.1, 0.4}});
  simulation.step();
  EXPECT_EQ(simulation.ground_truth().eggs[0].state, world::EggState::kCollected);
}

}  // namespace
}  // namespace coop::simulator
