#pragma once
#include "chassis_driver/base.hpp"

namespace coop::chassis_driver {

/// A base without a world: wheels and steering follow their set points exactly and at once, and
/// nothing slips. For bench tests of all that lies above.
class LoopbackBase : public Base {
 public:
  LoopbackBase(const vehicle::AckermannGeometry& geometry, double metres_per_tick);

  vehicle::WheelReading exchange(const vehicle::DriveSetpoint& setpoint, Time now,
                                 Duration dt) override;

 private:
  vehicle::AckermannGeometry geometry_;
  double metres_per_tick_;
  vehicle::DriveSetpoint setpoint_;  ///< in force since the last exchange
  double left_ = 0.0;                ///< rolled by the rear wheels, m
  double right_ = 0.0;
};

}  // namespace coop::chassis_driver
