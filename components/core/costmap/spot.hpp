#pragma once
#include <Eigen/Core>

namespace coop {

/// A round spot of the floor to keep clear of, although the laser sees nothing there.
struct Spot {
  Eigen::Vector2d center_in_map{0, 0};
  double radius = 0.0;  ///< m
  bool operator==(const Spot&) const = default;
};

}  // namespace coop
