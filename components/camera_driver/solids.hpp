#pragma once
#include <Eigen/Geometry>
#include <optional>

/// Rays against what lies and walks on the floor. Everywhere: the ray is origin + depth *
/// direction, the direction need not be of length 1, and the answer is the first hit of positive
/// depth.
namespace coop::camera_driver {

struct SurfaceHit {
  double depth = 0.0;               ///< in lengths of the direction
  Eigen::Vector3d normal{0, 0, 1};  ///< outwards, of length 1
};

/// A duck egg on its side.
struct EggShape {
  Eigen::Vector3d center{0, 0, 0};  ///< m
  double heading = 0.0;             ///< rad, of the long axis

  [[nodiscard]] Eigen::AlignedBox3d bounds() const;
};
class EggSurface {
 public:
  explicit EggSurface(const EggShape& shape, const Eigen::Vector3d& ray_origin);
  [[nodiscard]] std::optional<SurfaceHit> cast(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Matrix3d to_unit_sphere_;
  Eigen::Vector3d origin_;  ///< of the rays where the egg is the unit sphere
  double outside_;
};

/// Stands upright.
struct Cylinder {
  Eigen::Vector2d center{0, 0};  ///< m
  double radius = 0.0;           ///< m
  double height = 0.0;           ///< m, from z = 0

  [[nodiscard]] Eigen::AlignedBox3d bounds() const;
  [[nodiscard]] std::optional<SurfaceHit> cast(const Eigen::Vector3d& origin,
                                               const Eigen::Vector3d& direction) const;
};

}  // namespace coop::camera_driver
