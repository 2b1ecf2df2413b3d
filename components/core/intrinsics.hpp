#pragma once
#include <Eigen/Core>

namespace coop {

/// Pinhole camera without distortion (a D435i has none to speak of). Optical frame: x right, y
/// down, z forward. The centre of pixel (column, row) has the coordinates (column, row).
struct Intrinsics {
  int width = 0;    ///< px
  int height = 0;   ///< px
  double fx = 0.0;  ///< px
  double fy = 0.0;  ///< px
  double cx = 0.0;  ///< px
  double cy = 0.0;  ///< px

  /// Pixel of a point before the camera (z > 0), m in the optical frame.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& point) const {
    return {cx + fx * point.x() / point.z(), cy + fy * point.y() / point.z()};
  }
  /// The point of depth 1 on the pixel's ray; times the depth in m it is the point seen.
  [[nodiscard]] Eigen::Vector3d ray(double column, double row) const {
    return {(column - cx) / fx, (row - cy) / fy, 1.0};
  }
};

}  // namespace coop
