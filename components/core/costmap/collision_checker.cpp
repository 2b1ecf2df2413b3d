#include "core/costmap/collision_checker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coop {
namespace {

std::int32_t squared_cells(double distance, double resolution, double (*round)(double)) {
  const double cells = distance / resolution;
  return static_cast<std::int32_t>(round(cells * cells));
}

/// Whether the box holds a point of the footprint, as seen from the box's middle with a margin for
/// its corners.
bool may_overlap(const Footprint& footprint, const Eigen::Vector2d& middle, double half_diagonal) {
  return footprint.depth(middle) >= -half_diagonal;
}

}  // namespace

CollisionChecker::CollisionChecker(const Footprint& footprint, double resolution)
    : corners_(footprint.vertices()), radius_(footprint.circumscribed_radius()) {
  const Eigen::Vector2d size = footprint.upper() - footprint.lower();
  reach_ = 0.5 * size.norm() + 2.0 * resolution;
  divide(footprint, footprint.lower(), footprint.upper(), resolution);
  axis_radius_ = 0.5 * std::min(size.x(), size.y());
  axis_y_ = 0.5 * (footprint.lower().y() + footprint.upper().y());
  const double first = footprint.lower().x() + axis_radius_;
  const double length = std::max(0.0, size.x() - 2.0 * axis_radius_);
  const int gaps = static_cast<int>(std::ceil(length / std::max(axis_radius_, 1e-6)));
  for (int i = 0; i <= gaps; ++i) {
    axis_.push_back(gaps == 0 ? first + 0.5 * length : first + length * i / gaps);
  }
}

void CollisionChecker::divide(const Footprint& footprint, const Eigen::Vector2d& lower,
                              const Eigen::Vector2d& upper, double resolution) {
  const Eigen::Vector2d middle = 0.5 * (lower + upper);
  const Eigen::Vector2d size = upper - lower;
  const double half_diagonal = 0.5 * size.norm();
  const bool leaf = size.maxCoeff() <= 0.5 * resolution;
  if (leaf ? !footprint.contains(middle) : !may_overlap(footprint, middle, half_diagonal)) return;
  // The look-up is at the middle of a cell, up to half a cell's diagonal from the box's middle; an
  // obstacle reaches as far beyond its cell's middle.
  const double half_cell = resolution * std::numbers::sqrt2 / 2.0;
  const double inside = footprint.depth(middle) - half_cell;
  const std::size_t index = boxes_.size();
  boxes_.push_back(
      {middle.x(), middle.y(),
       leaf ? 1 : squared_cells(half_diagonal + 2.0 * half_cell, resolution, std::ceil),
       inside > 0.0 ? squared_cells(inside, resolution, std::floor) : (leaf ? 0 : -1), 0});
  if (!leaf) {
    Eigen::Vector2d upper_of_first = upper;
    Eigen::Vector2d lower_of_second = lower;
    const int axis = size.x() >= size.y() ? 0 : 1;
    upper_of_first[axis] = lower_of_second[axis] = middle[axis];
    divide(footprint, lower, upper_of_first, resolution);
    divide(footprint, lower_of_second, upper, resolution);
  }
  boxes_[index].skip = static_cast<std::int32_t>(boxes_.size());
}

bool CollisionChecker::collides(const DistanceField& field, const Placement& placement) const {
  const GridGeometry& grid = field.geometry();
  const double scale = 1.0 / grid.resolution;
  const double c = placement.cosine * scale;
  const double s = placement.sine * scale;
  const double x0 = (placement.x - grid.origin.x()) * scale;
  const double y0 = (placement.y - grid.origin.y()) * scale;
  // The distance field ends at the border and does not count it as an obstacle.
  const double rim = radius_ * scale;
  if (x0 < rim || y0 < rim || x0 + rim > grid.width || y0 + rim > grid.height) {
    for (const Eigen::Vector2d& corner : corners_) {
      const double x = x0 + c * corner.x() - s * corner.y();
      const double y = y0 + s * corner.x() + c * corner.y();
      if (x < 0.0 || y < 0.0 || x > grid.width || y > grid.height) return true;
    }
  }
  const auto end = static_cast<std::int32_t>(boxes_.size());
  for (std::int32_t i = 0; i < end;) {
    const Box& box = boxes_[static_cast<std::size_t>(i)];
    const Cell cell{static_cast<int>(std::floor(x0 + c * box.x - s * box.y)),
                    static_cast<int>(std::floor(y0 + s * box.x + c * box.y))};
    const std::int32_t squared = field.squared_at(cell);
    if (squared <= box.hit_up_to) return true;
    i = squared >= box.free_from ? box.skip : i + 1;
  }
  return false;
}

double CollisionChecker::clearance(const DistanceField& field, const Placement& placement) const {
  const GridGeometry& grid = field.geometry();
  const double c = placement.cosine;
  const double s = placement.sine;
  std::int32_t nearest = field.cap() * field.cap();
  for (const double x : axis_) {
    const Eigen::Vector2d point(placement.x + c * x - s * axis_y_,
                                placement.y + s * x + c * axis_y_);
    nearest = std::min(nearest, field.squared_at(grid.cell_of(point)));
  }
  return std::sqrt(static_cast<double>(nearest)) * grid.resolution - axis_radius_;
}

}  // namespace coop
