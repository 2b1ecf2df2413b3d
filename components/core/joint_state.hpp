#pragma once
#include <string>
#include <vector>

#include "core/time.hpp"

namespace coop {

/// State of joints. Each list of numbers is as long as `names`, or empty where it is not known.
struct JointState {
  Time stamp{};
  std::vector<std::string> names;
  std::vector<double> positions;   ///< rad, or m for prismatic joints
  std::vector<double> velocities;  ///< rad/s or m/s
  std::vector<double> efforts;     ///< N m or N
};

}  // namespace coop
