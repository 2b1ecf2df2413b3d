#include "camera_driver/solids.hpp"

#include <cmath>

#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

Eigen::Vector3d egg_half_axes() {
  return {world::kEggHalfLength, world::kEggHalfWidth, world::kEggHalfWidth};
}

}  // namespace

Eigen::AlignedBox3d EggShape::bounds() const {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(world::kEggHalfLength);
  return {center - reach, center + reach};
}

EggSurface::EggSurface(const EggShape& shape, const Eigen::Vector3d& ray_origin) {
  const Eigen::AngleAxisd turn(-shape.heading, Eigen::Vector3d::UnitZ());
  to_unit_sphere_ = egg_half_axes().cwiseInverse().asDiagonal() * turn.toRotationMatrix();
  origin_ = to_unit_sphere_ * (ray_origin - shape.center);
  outside_ = origin_.squaredNorm() - 1.0;
}

std::optional<SurfaceHit> EggSurface::cast(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d d = to_unit_sphere_ * direction;
  const double a = d.squaredNorm();
  const double b = origin_.dot(d);
  const double discriminant = b * b - a * outside_;
  if (discriminant < 0.0) return std::nullopt;
  const double depth = (-b - std::sqrt(discriminant)) / a;
  if (depth <= 0.0) return std::nullopt;
  const Eigen::Vector3d normal = to_unit_sphere_.transpose() * (origin_ + depth * d);
  return SurfaceHit{depth, normal.normalized()};
}

Eigen::AlignedBox3d Cylinder::bounds() const {
  return {Eigen::Vector3d(center.x() - radius, center.y() - radius, 0.0),
          Eigen::Vector3d(center.x() + radius, center.y() + radius, height)};
}

std::optional<SurfaceHit> Cylinder::cast(const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction) const {
  const Eigen::Vector2d from_center = origin.head<2>() - center;
  if (origin.z() > height && direction.z() < 0.0) {
    const double depth = (height - origin.z()) / direction.z();
    if ((from_center + depth * direction.head<2>()).squaredNorm() <= radius * radius) {
      return SurfaceHit{depth, Eigen::Vector3d::UnitZ()};
    }
  }
  const double a = direction.head<2>().squaredNorm();
  const double b = from_center.dot(direction.head<2>());
  const double discriminant = b * b - a * (from_center.squaredNorm() - radius * radius);
  if (a == 0.0 || discriminant < 0.0) return std::nullopt;
  const double depth = (-b - std::sqrt(discriminant)) / a;
  const double z = origin.z() + depth * direction.z();
  if (depth <= 0.0 || z < 0.0 || z > height) return std::nullopt;
  const Eigen::Vector2d outwards = (from_center + depth * direction.head<2>()) / radius;
  return SurfaceHit{depth, {outwards.x(), outwards.y(), 0.0}};
}

}  // namespace coop::camera_driver
