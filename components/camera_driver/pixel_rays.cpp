#include "camera_driver/pixel_rays.hpp"

#include <algorithm>
#include <cmath>

namespace coop::camera_driver {
namespace {

PixelRay make_ray(const Eigen::Vector3d& camera, const Eigen::Vector3d& direction,
                  double obstacle_height, double max_depth) {
  PixelRay ray;
  ray.direction = direction.cast<float>();
  ray.level_length = static_cast<float>(direction.head<2>().norm());
  const double dz = direction.z();
  const double to_height = dz == 0.0 ? -1.0 : (obstacle_height - camera.z()) / dz;
  const bool above = camera.z() > obstacle_height;
  double enter = 0.0;
  double leave = max_depth;
  if (above) enter = to_height > 0.0 ? to_height : max_depth;
  if (!above && dz > 0.0) leave = std::min(leave, to_height);
  if (dz < 0.0) {
    const double to_floor = -camera.z() / dz;
    ray.meets_floor = to_floor > 0.0 && to_floor <= max_depth;
    leave = std::min(leave, to_floor);
  }
  ray.enter = static_cast<float>(std::min(enter, leave));
  ray.leave = static_cast<float>(leave);
  return ray;
}

}  // namespace

PixelRays::PixelRays(const Intrinsics& intrinsics, const Pose3& camera_in_base,
                     double obstacle_height, double max_depth)
    : intrinsics_(intrinsics), camera_in_base_(camera_in_base) {
  rays_.reserve(static_cast<std::size_t>(intrinsics.width) *
                static_cast<std::size_t>(intrinsics.height));
  for (int row = 0; row < intrinsics.height; ++row) {
    for (int column = 0; column < intrinsics.width; ++column) {
      rays_.push_back(make_ray(camera(), camera_in_base.linear() * intrinsics.ray(column, row),
                               obstacle_height, max_depth));
    }
  }
}

PixelBlock PixelRays::cover(const Eigen::AlignedBox3d& box_in_base) const {
  constexpr double kNearest = 0.05;  // m of depth, nearer things have no bounds to speak of
  const Pose3 base_in_camera = camera_in_base_.inverse();
  Eigen::AlignedBox2d seen;
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
    const Eigen::Vector3d point = base_in_camera * box_in_base.corner(corner);
    nearest = std::min(nearest, point.z());
    farthest = std::max(farthest, point.z());
    if (point.z() > kNearest) seen.extend(intrinsics_.project(point));
  }
  if (farthest <= kNearest) return {};
  if (nearest <= kNearest) return {0, 0, intrinsics_.width, intrinsics_.height};
  const auto clamped = [](double pixel, int size) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size)));
  };
  return {clamped(std::floor(seen.min().x()), intrinsics_.width),
          clamped(std::floor(seen.min().y()), intrinsics_.height),
          clamped(std::ceil(seen.max().x()) + 1.0, intrinsics_.width),
          clamped(std::ceil(seen.max().y()) + 1.0, intrinsics_.height)};
}

}  // namespace coop::camera_driver
