#pragma once
#include "core/vehicle/ackermann.hpp"

namespace coop::vehicle::test {

/// A small base for figures that can be checked by hand.
inline constexpr AckermannGeometry kBase{.wheelbase = 0.5,
                                         .track = 0.4,
                                         .wheel_radius = 0.1,
                                         .max_steering_angle = 0.6,
                                         .max_steering_rate = 0.8};

}  // namespace coop::vehicle::test
