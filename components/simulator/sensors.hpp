#pragma once
#include "core/config/fields.hpp"
#include "core/imu_reading.hpp"
#include "core/random.hpp"
#include "core/vehicle/wheel_odometry.hpp"
#include "simulator/vehicle_dynamics.hpp"

namespace coop::simulator {

/// Encoders and steering sensor as built: systematic errors that odometry does not know of.
struct WheelSensorConfig {
  double left_scale = 1.004;     ///< indicated / rolled distance of the rear left wheel (tyre wear)
  double right_scale = 1.002;    ///< the same on the right
  double steering_bias = 0.002;  ///< rad, indicated minus set
  double steering_noise = 0.001;  ///< rad, deviation of one reading
  double scale_spread = 0.0;      ///< deviation over runs of each wheel's scale
  vehicle::WheelOdometryConfig odometry;

  void describe(config::Fields& fields);
};

/// From rolled wheels to odometry, by way of whole encoder ticks.
class WheelSensor {
 public:
  WheelSensor(const WheelSensorConfig& config, const vehicle::AckermannGeometry& base,
              std::uint64_t seed);

  void roll(double left, double right);
  /// Reads encoders and steering and integrates them.
  void read(double steering, Time stamp);

  [[nodiscard]] const vehicle::WheelOdometry& odometry() const { return odometry_; }

  template <class Archive>
  void persist(Archive& archive) {
    archive(left_, right_, noise_, odometry_);
  }

 private:
  WheelSensorConfig config_;
  RandomStream noise_;
  vehicle::WheelOdometry odometry_;
  double left_ = 0.0;   ///< indicated travel, m
  double right_ = 0.0;  ///< m
};

/// Of a MEMS unit as in common depth cameras, sampled at 100 Hz; biases are drawn once a run.
struct ImuConfig {
  double gyro_noise = 0.0025;  ///< rad/s, deviation of one reading
  double gyro_bias = 0.002;    ///< rad/s, deviation of the bias
  double accel_noise = 0.03;   ///< m/s^2
  double accel_bias = 0.05;    ///< m/s^2

  void describe(config::Fields& fields);
};

class ImuSensor {
 public:
  ImuSensor(const ImuConfig& config, const Pose3& imu_in_base, std::uint64_t seed);

  /// `before` and `after` are the base's velocities over ground, `dt` seconds apart.
  [[nodiscard]] ImuReading read(const Twist2& before, const Twist2& after, double dt, Time stamp);

  template <class Archive>
  void persist(Archive& archive) {
    archive(noise_);
  }

 private:
  ImuConfig config_;
  Pose3 imu_in_base_;
  Eigen::Vector3d gyro_bias_;   ///< rad/s
  Eigen::Vector3d accel_bias_;  ///< m/s^2
  RandomStream noise_;
};

}  // namespace coop::simulator
