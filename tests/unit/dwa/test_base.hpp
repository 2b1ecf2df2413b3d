#pragma once
#include <vector>

#include "core/vehicle/ackermann.hpp"

namespace coop::test {

/// Wheelbase 0.55 m, steering up to 0.6 rad: turning radius 0.80 m.
inline vehicle::AckermannGeometry test_base() {
  vehicle::AckermannGeometry base;
  base.wheelbase = 0.55;
  base.track = 0.48;
  base.max_steering_angle = 0.60;
  return base;
}
inline constexpr double kSteeringRate = 0.8;  // rad/s
inline const std::vector<Eigen::Vector2d> kBaseFootprint{
    {-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}};

}  // namespace coop::test
