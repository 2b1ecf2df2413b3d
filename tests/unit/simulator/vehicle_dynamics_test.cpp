#include "simulator/vehicle_dynamics.hpp"

#include <gtest/gtest.h>

#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

constexpr double kDt = 0.01;

VehicleDynamics vehicle_with(const VehicleConfig& config, std::uint64_t seed = 1) {
  return {config, test::robot().base, Pose2{}, seed};
}

void run(VehicleDynamics& vehicle, int ticks, double speed, double steering) {
  for (int i = 0; i < ticks; ++i) {
    vehicle.move(vehicle.roll({speed, steering, vehicle::DriveCause::kCommand}, kDt), kDt);
  }
}

TEST(VehicleDynamics, TheSpeedFollowsItsSetPointWithAFirstOrderLag) {
  VehicleConfig config = test::ideal().vehicle;
  config.speed_time_constant = 0.2;
  VehicleDynamics vehicle = vehicle_with(config);
  run(vehicle, 20, 0.5, 0.0);  // one time constant
  EXPECT_NEAR(vehicle.state().speed, 0.5 * (1 - std::exp(-1.0)), 1e-12);
  run(vehicle, 20, 0.5, 0.0);
  EXPECT_NEAR(vehicle.state().speed, 0.5 * (1 - std::exp(-2.0)), 1e-12);
}

TEST(VehicleDynamics, TheSteeringFollowsItsSetPointWithAFirstOrderLag) {
  VehicleConfig config = test::ideal().vehicle;
  config.steering_time_constant = 0.1;
  VehicleDynamics vehicle = vehicle_with(config);
  run(vehicle, 10, 0.0, 0.3);
  EXPECT_NEAR(vehicle.state().steering, 0.3 * (1 - std::exp(-1.0)), 1e-12);
}

TEST(VehicleDynamics, AnIdealVehicleDrivesACircle) {
  VehicleDynamics vehicle = vehicle_with(test::ideal().vehicle);
  // Curvature 1, 0.5 m/s: half a circle of radius 1 in 2 pi seconds.
  run(vehicle, 628, 0.5, std::atan(0.5));
  EXPECT_NEAR(vehicle.state().robot_in_world.x, std::sin(3.14), 1e-9);
  EXPECT_NEAR(vehicle.state().robot_in_world.y, 1 - std::cos(3.14), 1e-9);
  EXPECT_NEAR(vehicle.state().velocity.omega, 0.5, 1e-12);
}

TEST(VehicleDynamics, EvenSlipShortensTheWayAndLeavesTheHeading) {
  VehicleConfig config = test::ideal().vehicle;
  config.slip = {.left = 0.1, .right = 0.1, .random = 0, .yaw_share = 1.0};
  VehicleDynamics vehicle = vehicle_with(config);
  run(vehicle, 200, 0.5, 0.0);
  EXPECT_NEAR(vehicle.state().robot_in_world.x, 0.9, 1e-12);
  EXPECT_NEAR(vehicle.state().robot_in_world.yaw, 0.0, 1e-12);
}

TEST(VehicleDynamics, AWheelThatSlipsMoreTurnsTheRobotToItsSide) {
  VehicleConfig config = test::ideal().vehicle;
  config.slip = {.left = 0.0, .right = 0.04, .random = 0, .yaw_share = 0.5};
  VehicleDynamics vehicle = vehicle_with(config);
  run(vehicle, 200, 0.5, 0.0);
  // Over 1 m the right wheel loses 0.04 m; half of 0.04 / 0.4 m of track.
  EXPECT_NEAR(vehicle.state().robot_in_world.yaw, -0.05, 1e-12);
}

TEST(VehicleDynamics, RandomSlipHasTheDeviationItIsGivenPerMetre) {
  VehicleConfig config = test::ideal().vehicle;
  config.slip.random = 0.02;
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kRuns = 400;
  for (int seed = 0; seed < kRuns; ++seed) {
    VehicleDynamics vehicle = vehicle_with(config, static_cast<std::uint64_t>(seed));
    run(vehicle, 200, 0.5, 0.0);
    const double error = vehicle.state().robot_in_world.x - 1.0;
    sum += error;
    squares += error * error;
  }
  // The mean of two wheels deviates by 0.02 / sqrt(2) over a metre. Bounds: five deviations of the
  // estimates.
  const double deviation = 0.02 / std::sqrt(2.0);
  EXPECT_NEAR(sum / kRuns, 0.0, 5 * deviation / std::sqrt(kRuns));
  EXPECT_NEAR(std::sqrt(squares / kRuns), deviation, 5 * deviation / std::sqrt(2.0 * kRuns));
}

TEST(VehicleDynamics, ARobotAskedToStandComesToRestAndStaysThere) {
  VehicleDynamics vehicle = vehicle_with({});
  run(vehicle, 200, 0.5, 0.1);
  run(vehicle, 200, 0.0, 0.1);
  EXPECT_EQ(vehicle.state().speed, 0.0);
  const Pose2 rest = vehicle.state().robot_in_world;
  run(vehicle, 500, 0.0, 0.1);
  EXPECT_EQ(vehicle.state().robot_in_world, rest);
}

TEST(VehicleDynamics, EncodersSeeWhatWasRolledNotWhatWasTravelled) {
  VehicleConfig config = test::ideal().vehicle;
  config.slip = {.left = 0.5, .right = 0.5, .random = 0, .yaw_share = 0};
  VehicleDynamics vehicle = vehicle_with(config);
  const VehicleMotion motion = vehicle.roll({0.5, 0.0, vehicle::DriveCause::kCommand}, kDt);
  EXPECT_DOUBLE_EQ(motion.rolled_left, 0.005);
  EXPECT_DOUBLE_EQ(motion.distance, 0.0025);
}

}  // namespace
}  // namespace coop::simulator
