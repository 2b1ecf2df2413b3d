#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "core/config/fields.hpp"
#include "core/odometry.hpp"
#include "core/vehicle/ackermann.hpp"

namespace coop::vehicle {

/// Growth of the odometry's covariance with the motion (as the odometry motion model of Thrun,
/// Burgard, Fox: Probabilistic Robotics, table 5.5): standard deviations a square root of a metre
/// or a radian.
struct OdometryNoise {
  double translation_per_metre = 0.02;  ///< m per sqrt(m)
  double rotation_per_radian = 0.03;    ///< rad per sqrt(rad)
  double rotation_per_metre = 0.02;     ///< rad per sqrt(m)

  void describe(config::Fields& fields);
};

/// Integrates motion increments to the pose in `odom` along exact arcs, with covariance by linear
/// propagation.
class OdometryIntegrator {
 public:
  explicit OdometryIntegrator(const OdometryNoise& noise = {}, const Pose2& start = {});

  /// Motion since the last call; the velocity is the increment over the time between the stamps,
  /// zero at the first call.
  void advance(double distance, double turn, Time stamp);

  [[nodiscard]] const Odometry& odometry() const { return odometry_; }
  /// Of x, y, yaw in odom.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }

  /// Hands the state to something that stores or restores it.
  template <class Archive>
  void persist(Archive& archive) {
    archive(odometry_, covariance_);
  }

 private:
  OdometryNoise noise_;
  Odometry odometry_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

/// What the base measures in one cycle.
struct WheelReading {
  Time stamp{};
  std::int64_t rear_left_ticks = 0;   ///< since power-up
  std::int64_t rear_right_ticks = 0;  ///< since power-up
  double steering = 0.0;              ///< rad
};

struct WheelOdometryConfig {
  double metres_per_tick = 0.0005;  ///< of the rear wheels' encoders
  OdometryNoise noise;

  void describe(config::Fields& fields);
};

/// Odometry from the rear wheels' encoders and the steering angle. The distance is the mean of the
/// wheels; the turn follows from the steering angle (the mean of this reading's and the last
/// one's), because the difference of two wheels that slip on litter tells less.
class WheelOdometry {
 public:
  WheelOdometry(const WheelOdometryConfig& config, const AckermannGeometry& base,
                const Pose2& start = {});

  /// The first reading only sets the reference.
  const Odometry& update(const WheelReading& reading);

  [[nodiscard]] const Odometry& odometry() const { return integrator_.odometry(); }
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return integrator_.covariance(); }

  template <class Archive>
  void persist(Archive& archive) {
    archive(integrator_, last_, has_last_);
  }

 private:
  WheelOdometryConfig config_;
  AckermannGeometry base_;
  OdometryIntegrator integrator_;
  WheelReading last_;
  bool has_last_ = false;
};

}  // namespace coop::vehicle
