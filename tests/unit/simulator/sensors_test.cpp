#include "simulator/sensors.hpp"

#include <gtest/gtest.h>

#include "unit/simulator/sketch.hpp"

namespace coop::simulator {
namespace {

TEST(WheelSensor, CountsWholeTicksAndLosesNoFraction) {
  WheelSensorConfig config = test::ideal().wheel_sensor;
  config.odometry.metres_per_tick = 0.01;
  WheelSensor sensor(config, test::robot().base, 1);
  sensor.read(0.0, time_from_seconds(1.0));
  for (int i = 0; i < 10; ++i) sensor.roll(0.0035, 0.0035);  // 3.5 ticks in all
  sensor.read(0.0, time_from_seconds(1.1));
  EXPECT_NEAR(sensor.odometry().odometry().base_in_odom.x, 0.03, 1e-12);
  for (int i = 0; i < 10; ++i) sensor.roll(0.0035, 0.0035);
  sensor.read(0.0, time_from_seconds(1.2));
  EXPECT_NEAR(sensor.odometry().odometry().base_in_odom.x, 0.07, 1e-12);
}

TEST(WheelSensor, WornTyresMakeTheWayLonger) {
  WheelSensorConfig config = test::ideal().wheel_sensor;
  config.left_scale = 1.02;
  config.right_scale = 1.04;
  config.odometry.metres_per_tick = 1e-6;
  WheelSensor sensor(config, test::robot().base, 1);
  sensor.read(0.0, time_from_seconds(1.0));
  sensor.roll(1.0, 1.0);
  sensor.read(0.0, time_from_seconds(2.0));
  EXPECT_NEAR(sensor.odometry().odometry().base_in_odom.x, 1.03, 1e-5);
}

TEST(WheelSensor, ABiasOfTheSteeringSensorBendsTheOdometry) {
  WheelSensorConfig config = test::ideal().wheel_sensor;
  config.steering_bias = 0.01;
  config.odometry.metres_per_tick = 1e-6;
  WheelSensor sensor(config, test::robot().base, 1);
  sensor.read(0.0, time_from_seconds(1.0));
  sensor.roll(1.0, 1.0);
  sensor.read(0.0, time_from_seconds(2.0));
  EXPECT_NEAR(sensor.odometry().odometry().base_in_odom.yaw, std::tan(0.01) / 0.5, 1e-6);
}

TEST(ImuSensor, AtRestItFeelsGravityAlone) {
  ImuSensor imu(test::ideal().imu, Pose3::Identity(), 1);
  const ImuReading reading = imu.read({}, {}, 0.01, time_from_seconds(1.0));
  EXPECT_EQ(reading.angular_velocity, Eigen::Vector3d::Zero());
  EXPECT_EQ(reading.linear_acceleration, Eigen::Vector3d(0, 0, 9.80665));
  EXPECT_FALSE(reading.orientation.has_value());
}

TEST(ImuSensor, OnACircleItFeelsTheCentripetalAccelerationOfItsOwnPlace) {
  // 0.5 m/s and 1 rad/s to the left: base_link on a circle of 0.5 m; the unit 0.3 m ahead of it.
  Pose3 mount = Pose3::Identity();
  mount.translation() << 0.3, 0.0, 0.1;
  ImuSensor imu(test::ideal().imu, mount, 1);
  const ImuReading reading = imu.read({0.5, 1.0}, {0.5, 1.0}, 0.01, time_from_seconds(1.0));
  EXPECT_NEAR(reading.angular_velocity.z(), 1.0, 1e-12);
  EXPECT_NEAR(reading.linear_acceleration.x(), -0.3, 1e-12);
  EXPECT_NEAR(reading.linear_acceleration.y(), 0.5, 1e-12);
}

TEST(ImuSensor, ATurnedUnitMeasuresInItsOwnAxes) {
  Pose3 mount = Pose3::Identity();
  mount.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  ImuSensor imu(test::ideal().imu, mount, 1);
  const ImuReading reading = imu.read({0.0, 0.0}, {0.02, 0.0}, 0.01, time_from_seconds(1.0));
  EXPECT_NEAR(reading.linear_acceleration.x(), 0.0, 1e-12);  // its x axis points left
  EXPECT_NEAR(reading.linear_acceleration.y(), -2.0, 1e-12);
}

TEST(ImuSensor, NoiseAndBiasHaveTheirDeviations) {
  ImuConfig config{.gyro_noise = 0.01, .gyro_bias = 0.0, .accel_noise = 0.0, .accel_bias = 0.0};
  ImuSensor imu(config, Pose3::Identity(), 3);
  double squares = 0.0;
  constexpr int kReadings = 10000;
  for (int i = 0; i < kReadings; ++i) {
    squares += imu.read({}, {}, 0.01, Time{}).angular_velocity.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / (3 * kReadings)), 0.01, 0.0002);

  config = {.gyro_noise = 0.0, .gyro_bias = 0.02, .accel_noise = 0.0, .accel_bias = 0.0};
  squares = 0.0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    ImuSensor biased(config, Pose3::Identity(), seed);
    const Eigen::Vector3d first = biased.read({}, {}, 0.01, Time{}).angular_velocity;
    EXPECT_EQ(first, biased.read({}, {}, 0.01, Time{}).angular_velocity);
    squares += first.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / 3000), 0.02, 0.0013);
}

}  // namespace
}  // namespace coop::simulator
