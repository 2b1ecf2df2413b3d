#include <gtest/gtest.h>

#include <cmath>

#include "simulator/sensors.hpp"
#include "simulator/vehicle_dynamics.hpp"

namespace coop::simulator {
namespace {

const vehicle::AckermannGeometry kBase{.wheelbase = 0.55,
                                       .track = 0.44,
                                       .wheel_radius = 0.1,
                                       .max_steering_angle = 0.6,
                                       .max_steering_rate = 0.8};
constexpr double kTick = 0.01;

/// Without lag and slip, so that what is left is the actuators' own error.
VehicleConfig plain() {
  VehicleConfig config;
  config.speed_time_constant = 0.0;
  config.steering_time_constant = 0.0;
  config.slip = {.left = 0.0, .right = 0.0, .random = 0.0, .yaw_share = 0.0};
  return config;
}

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

template <class Value>
Spread spread_over(int count, Value value) {
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double v = value(i);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean)};
}

TEST(ActuatorError, without_it_the_base_does_as_it_is_told) {
  VehicleDynamics vehicle(plain(), kBase, {}, 1);
  const VehicleMotion motion = vehicle.roll({.speed = 0.5, .steering = 0.1}, kTick);
  EXPECT_NEAR(motion.distance, 0.005, 1e-12);
  EXPECT_DOUBLE_EQ(vehicle.state().steering, 0.1);
}

TEST(ActuatorError, wanders_with_the_deviations_set) {
  VehicleConfig config = plain();
  config.actuators = {
      .speed = 0.03, .steering = 0.01, .correlation_time = 0.1, .steering_offset = 0.0};
  VehicleDynamics vehicle(config, kBase, {}, 1);
  double steering_squares = 0.0;
  constexpr int kTicks = 20000;
  const Spread speed = spread_over(kTicks, [&](int) {
    vehicle.roll({.speed = 0.5, .steering = 0.0}, kTick);
    steering_squares += vehicle.state().steering * vehicle.state().steering;
    return vehicle.state().speed;
  });
  EXPECT_NEAR(speed.mean, 0.5, 0.003);
  EXPECT_NEAR(speed.deviation, 0.5 * 0.03, 0.002);
  EXPECT_NEAR(std::sqrt(steering_squares / kTicks), 0.01, 0.001);
}

TEST(ActuatorError, a_base_told_to_stand_stands) {
  VehicleConfig config = plain();
  config.actuators.speed = 0.1;
  VehicleDynamics vehicle(config, kBase, {}, 1);
  vehicle.roll({.speed = 0.5, .steering = 0.0}, kTick);
  EXPECT_DOUBLE_EQ(vehicle.roll({.speed = 0.0, .steering = 0.0}, kTick).distance, 0.0);
}

TEST(ActuatorError, the_adjustment_of_the_steering_is_drawn_once_a_run) {
  VehicleConfig config = plain();
  config.actuators.steering_offset = 0.005;
  const Spread offset = spread_over(400, [&](int seed) {
    VehicleDynamics vehicle(config, kBase, {}, static_cast<std::uint64_t>(seed));
    const double turn = vehicle.roll({.speed = 0.5, .steering = 0.0}, kTick).turn;
    EXPECT_DOUBLE_EQ(vehicle.roll({.speed = 0.5, .steering = 0.0}, kTick).turn, turn);
    return std::atan(turn / 0.005 * kBase.wheelbase);
  });
  EXPECT_NEAR(offset.deviation, 0.005, 0.0006);
}

TEST(ActuatorError, does_not_shift_the_numbers_of_slip) {
  VehicleConfig config = plain();
  config.slip.random = 0.004;
  VehicleConfig erring = config;
  erring.actuators.steering = 0.01;
  VehicleDynamics a(config, kBase, {}, 1);
  VehicleDynamics b(erring, kBase, {}, 1);
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(a.roll({.speed = 0.5, .steering = 0.0}, kTick).distance,
                b.roll({.speed = 0.5, .steering = 0.0}, kTick).distance, 1e-5);
  }
}

TEST(WheelScale, is_drawn_once_a_run) {
  WheelSensorConfig config;
  config.left_scale = 1.0;
  config.right_scale = 1.0;
  config.steering_bias = 0.0;
  config.steering_noise = 0.0;
  config.scale_spread = 0.005;
  const Spread travelled = spread_over(400, [&](int seed) {
    WheelSensor sensor(config, kBase, static_cast<std::uint64_t>(seed));
    sensor.read(0.0, time_from_seconds(1.0));
    sensor.roll(10.0, 10.0);
    sensor.read(0.0, time_from_seconds(2.0));
    return sensor.odometry().odometry().base_in_odom.position().norm();
  });
  EXPECT_NEAR(travelled.mean, 10.0, 0.01);
  // The mean of two wheels.
  EXPECT_NEAR(travelled.deviation, 0.05 / std::sqrt(2.0), 0.006);
}

}  // namespace
}  // namespace coop::simulator
