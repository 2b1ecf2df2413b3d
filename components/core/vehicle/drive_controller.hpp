#pragma once
#include "core/vehicle/ackermann.hpp"
#include "core/vehicle/command_gate.hpp"

namespace coop::vehicle {

/// What the base's two actuators are asked for.
struct DriveSetpoint {
  double speed = 0.0;     ///< of base_link, m/s
  double steering = 0.0;  ///< rad
  DriveCause cause = DriveCause::kNoCommand;
};

struct DriveConfig {
  DriveLimits limits;
  CommandGateConfig watchdog;

  void describe(config::Fields& fields);
};

/// From velocity commands to actuator set points that never break the drive's limits. A command
/// whose turn is tighter than the steering allows keeps its speed and gets the tightest circle; a
/// stop keeps the wheels' angle.
class DriveController {
 public:
  DriveController(const DriveConfig& config, const AckermannGeometry& base);

  [[nodiscard]] CommandGate& gate() { return gate_; }
  [[nodiscard]] const CommandGate& gate() const { return gate_; }

  /// The set point for the period of length `dt` that ends at `now`.
  DriveSetpoint step(Time now, Duration dt);
  [[nodiscard]] const DriveSetpoint& setpoint() const { return setpoint_; }
  /// Takes up where another controller left off, or after the base was halted by force.
  void reset(const DriveSetpoint& setpoint) { setpoint_ = setpoint; }

 private:
  DriveLimits limits_;
  AckermannGeometry base_;
  CommandGate gate_;
  DriveSetpoint setpoint_;
};

}  // namespace coop::vehicle
