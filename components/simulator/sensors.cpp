#include "simulator/sensors.hpp"

#include <cmath>

namespace coop::simulator {
namespace {

constexpr double kGravity = 9.80665;  ///< m/s^2

Eigen::Vector3d normal_vector(RandomStream& stream, double deviation) {
  const double x = stream.normal();
  const double y = stream.normal();
  const double z = stream.normal();
  return deviation * Eigen::Vector3d(x, y, z);
}

Eigen::Vector3d bias_of(std::uint64_t seed, const char* name, double deviation) {
  RandomStream stream(seed, name);
  return normal_vector(stream, deviation);
}

}  // namespace

void WheelSensorConfig::describe(config::Fields& fields) {
  fields.number("left_scale", left_scale,
                {.unit = "1", .help = "indicated / rolled distance", .min = 0.5, .max = 2});
  fields.number("right_scale", right_scale,
                {.unit = "1", .help = "indicated / rolled distance", .min = 0.5, .max = 2});
  fields.number(
      "steering_bias", steering_bias,
      {.unit = "rad", .help = "indicated minus set steering angle", .min = -0.3, .max = 0.3});
  fields.number("steering_noise", steering_noise,
                {.unit = "rad", .help = "deviation of one steering reading", .min = 0, .max = 0.3});
  fields.number("scale_spread", scale_spread,
                {.unit = "1",
                 .help = "deviation over runs of each wheel's indicated / rolled distance",
                 .min = 0,
                 .max = 0.2});
  fields.section("odometry", odometry);
}

WheelSensor::WheelSensor(const WheelSensorConfig& config, const vehicle::AckermannGeometry& base,
                         std::uint64_t seed)
    : config_(config), noise_(seed, "simulator/steering_sensor"), odometry_(config.odometry, base) {
  RandomStream wear(seed, "simulator/wheel_scale");
  config_.left_scale += wear.normal(0.0, config.scale_spread);
  config_.right_scale += wear.normal(0.0, config.scale_spread);
}

void WheelSensor::roll(double left, double right) {
  left_ += left * config_.left_scale;
  right_ += right * config_.right_scale;
}

void WheelSensor::read(double steering, Time stamp) {
  const double per_tick = config_.odometry.metres_per_tick;
  vehicle::WheelReading reading;
  reading.stamp = stamp;
  reading.rear_left_ticks = static_cast<std::int64_t>(std::floor(left_ / per_tick));
  reading.rear_right_ticks = static_cast<std::int64_t>(std::floor(right_ / per_tick));
  reading.steering = steering + noise_.normal(config_.steering_bias, config_.steering_noise);
  odometry_.update(reading);
}

void ImuConfig::describe(config::Fields& fields) {
  fields.number("gyro_noise", gyro_noise,
                {.unit = "rad/s", .help = "deviation of one reading", .min = 0, .max = 1});
  fields.number("gyro_bias", gyro_bias,
                {.unit = "rad/s", .help = "deviation of the constant bias", .min = 0, .max = 1});
  fields.number("accel_noise", accel_noise,
                {.unit = "m/s^2", .help = "deviation of one reading", .min = 0, .max = 10});
  fields.number("accel_bias", accel_bias,
                {.unit = "m/s^2", .help = "deviation of the constant bias", .min = 0, .max = 10});
}

ImuSensor::ImuSensor(const ImuConfig& config, const Pose3& imu_in_base, std::uint64_t seed)
    : config_(config),
      imu_in_base_(imu_in_base),
      gyro_bias_(bias_of(seed, "simulator/imu/gyro_bias", config.gyro_bias)),
      accel_bias_(bias_of(seed, "simulator/imu/accel_bias", config.accel_bias)),
      noise_(seed, "simulator/imu/noise") {}

ImuReading ImuSensor::read(const Twist2& before, const Twist2& after, double dt, Time stamp) {
  const Eigen::Vector3d rate(0.0, 0.0, after.omega);
  const double rate_change = (after.omega - before.omega) / dt;
  // Acceleration of base_link in its own axes, then of the unit's place on the body: the lever's
  // tangential and centripetal parts.
  const Eigen::Vector3d lever = imu_in_base_.translation();
  const Eigen::Vector3d of_base((after.v - before.v) / dt, after.v * after.omega, kGravity);
  const Eigen::Vector3d of_lever(-rate_change * lever.y() - after.omega * after.omega * lever.x(),
                                 rate_change * lever.x() - after.omega * after.omega * lever.y(),
                                 0.0);
  const Eigen::Matrix3d to_unit = imu_in_base_.linear().transpose();
  ImuReading reading;
  reading.stamp = stamp;
  reading.frame_id = robot::kImuLink;
  reading.angular_velocity =
      to_unit * rate + gyro_bias_ + normal_vector(noise_, config_.gyro_noise);
  reading.linear_acceleration =
      to_unit * (of_base + of_lever) + accel_bias_ + normal_vector(noise_, config_.accel_noise);
  const auto variance = [](double noise, double bias) {
    return Eigen::Matrix3d(Eigen::Matrix3d::Identity() * (noise * noise + bias * bias));
  };
  reading.angular_velocity_covariance = variance(config_.gyro_noise, config_.gyro_bias);
  reading.linear_acceleration_covariance = variance(config_.accel_noise, config_.accel_bias);
  return reading;
}

}  // namespace coop::simulator
