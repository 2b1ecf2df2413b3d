#pragma once
#include <memory>

#include "chassis_driver/base.hpp"
#include "core/config/fields.hpp"

namespace coop::chassis_driver {

struct ChassisConfig {
  vehicle::DriveConfig drive;
  vehicle::WheelOdometryConfig odometry;

  void describe(config::Fields& fields);
};

/// One control cycle of the base: command in force (watchdog, emergency stop) -> set point within
/// the drive's limits -> wheels -> odometry.
class Chassis {
 public:
  Chassis(const ChassisConfig& config, const vehicle::AckermannGeometry& geometry,
          std::unique_ptr<Base> base);

  /// Velocity commands and emergency stops go in here.
  [[nodiscard]] vehicle::CommandGate& gate() { return drive_.gate(); }
  [[nodiscard]] const vehicle::DriveSetpoint& setpoint() const { return drive_.setpoint(); }

  /// The first cycle sets the references and moves nothing.
  void step(Time now);

  [[nodiscard]] const vehicle::WheelOdometry& odometry() const { return odometry_; }

 private:
  vehicle::DriveController drive_;
  vehicle::WheelOdometry odometry_;
  std::unique_ptr<Base> base_;
  Time last_{};
};

}  // namespace coop::chassis_driver
