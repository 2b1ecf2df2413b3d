#pragma once
#include <Eigen/Core>
#include <cmath>

namespace coop::robot {

/// Where the arm is sure to pick an egg: around the working point (the URDF's link
/// `working_point`), in base_link. The box lies within what the arm's inverse kinematics reaches.
struct WorkingRange {
  double along = 0.10;   ///< m, nearer or farther than the working point
  double across = 0.12;  ///< m, to either side

  /// `deviation`: egg minus working point in base_link, m.
  [[nodiscard]] bool contains(const Eigen::Vector2d& deviation) const {
    return std::abs(deviation.x()) <= along && std::abs(deviation.y()) <= across;
  }
};

}  // namespace coop::robot
