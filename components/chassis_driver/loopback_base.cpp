#include "chassis_driver/loopback_base.hpp"

#include <cmath>

namespace coop::chassis_driver {

LoopbackBase::LoopbackBase(const vehicle::AckermannGeometry& geometry, double metres_per_tick)
    : geometry_(geometry), metres_per_tick_(metres_per_tick) {}

vehicle::WheelReading LoopbackBase::exchange(const vehicle::DriveSetpoint& setpoint, Time now,
                                             Duration dt) {
  // The set point's period ends now: over it the wheels turned at the mean of old and new.
  const double span = to_seconds(dt);
  const vehicle::WheelSpeeds wheels =
      vehicle::wheel_speeds(geometry_, 0.5 * (setpoint.speed + setpoint_.speed),
                            0.5 * (setpoint.steering + setpoint_.steering));
  left_ += wheels.rear_left * span;
  right_ += wheels.rear_right * span;
  setpoint_ = setpoint;
  return {now, std::llround(left_ / metres_per_tick_), std::llround(right_ / metres_per_tick_),
          setpoint.steering};
}

}  // namespace coop::chassis_driver
