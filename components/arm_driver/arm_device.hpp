#pragma once
#include <optional>

#include "arm_driver/kinematic_chain.hpp"
#include "core/time.hpp"

namespace coop::arm_driver {

struct ArmReading {
  JointVector positions;       ///< measured, rad
  JointVector velocities;      ///< measured, rad/s
  bool suction = false;        ///< the pump runs
  double vacuum_kpa = 0.0;     ///< kPa below ambient
  std::optional<bool> vacuum;  ///< something closes the cup; nothing while that is not known
};

/// Joints with position servos and a suction gripper: the seam between the driver and what moves.
/// An implementation keeps to the last command until the next one, also while the driver is away.
class ArmDevice {
 public:
  virtual ~ArmDevice() = default;
  ArmDevice() = default;
  ArmDevice(const ArmDevice&) = delete;
  ArmDevice& operator=(const ArmDevice&) = delete;

  [[nodiscard]] virtual ArmReading read(Time now) = 0;
  /// `target` in rad, within the joints' limits.
  virtual void command(const JointVector& target, bool suction, Time now) = 0;
};

}  // namespace coop::arm_driver
