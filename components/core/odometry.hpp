#pragma once
#include "core/pose.hpp"
#include "core/time.hpp"

namespace coop {

/// Pose integrated from wheels and steering, smooth but drifting, and the velocity at that time.
struct Odometry {
  Time stamp{};
  Pose2 base_in_odom;
  Twist2 velocity;  ///< in base_link
};

}  // namespace coop
