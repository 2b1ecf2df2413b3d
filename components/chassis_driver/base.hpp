#pragma once
#include "core/time.hpp"
#include "core/vehicle/drive_controller.hpp"
#include "core/vehicle/wheel_odometry.hpp"

namespace coop::chassis_driver {

/// The seam between the driver and what turns the wheels: one exchange a control cycle. Behind it
/// stands the loopback, or a session with a motor controller (codec for its frames, session for its
/// line).
class Base {
 public:
  virtual ~Base() = default;
  /// Hands over the set point for the next `dt` and answers with what encoders and steering read at
  /// `now`.
  virtual vehicle::WheelReading exchange(const vehicle::DriveSetpoint& setpoint, Time now,
                                         Duration dt) = 0;
};

}  // namespace coop::chassis_driver
