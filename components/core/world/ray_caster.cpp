#include "core/world/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/world/state.hpp"

namespace coop::world {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One axis of the traversal, in cells: position = start + t * slope.
struct Axis {
  double start;
  double slope;

  /// Ray parameter at which the boundary `cells` is crossed.
  [[nodiscard]] double time_at(int boundary) const { return (boundary - start) / slope; }
  [[nodiscard]] int step() const { return slope > 0.0 ? 1 : -1; }
  /// Boundary ahead of cell `index`.
  [[nodiscard]] int boundary_ahead(int index) const { return slope > 0.0 ? index + 1 : index; }
  [[nodiscard]] double first_time(int index) const {
    return slope == 0.0 ? kInfinity : time_at(boundary_ahead(index));
  }
};

/// Ray parameters between which the axis lies within [0, cells]; empty interval where it never
/// does.
void clip(const Axis& axis, int cells, double& enter, double& leave) {
  if (axis.slope == 0.0) {
    if (axis.start < 0.0 || axis.start >= cells) leave = -kInfinity;
    return;
  }
  const double a = axis.time_at(0);
  const double b = axis.time_at(cells);
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

}  // namespace

RayCaster::RayCaster(const OccupancyGrid& grid)
    : geometry_(grid.geometry), blocked_(grid.cells.size()) {
  std::transform(grid.cells.begin(), grid.cells.end(), blocked_.begin(),
                 [&](std::int8_t value) { return is_occupied(value) ? 1 : 0; });
}

std::optional<RayHit> RayCaster::cast(const Eigen::Vector2d& origin,
                                      const Eigen::Vector2d& direction, double max_range) const {
  const double per_metre = 1.0 / geometry_.resolution;
  const Axis x{(origin.x() - geometry_.origin.x()) * per_metre, direction.x() * per_metre};
  const Axis y{(origin.y() - geometry_.origin.y()) * per_metre, direction.y() * per_metre};
  double enter = 0.0;
  double leave = max_range;
  clip(x, geometry_.width, enter, leave);
  clip(y, geometry_.height, enter, leave);
  if (enter > leave) return std::nullopt;

  Cell cell{
      std::clamp(static_cast<int>(std::floor(x.start + enter * x.slope)), 0, geometry_.width - 1),
      std::clamp(static_cast<int>(std::floor(y.start + enter * y.slope)), 0, geometry_.height - 1)};
  const bool entered_along_x =
      enter > 0.0 && x.slope != 0.0 && enter == std::min(x.time_at(0), x.time_at(geometry_.width));
  if (occupied(cell)) return RayHit{enter, cell, entered_along_x};

  const double dx = x.slope == 0.0 ? kInfinity : std::abs(1.0 / x.slope);
  const double dy = y.slope == 0.0 ? kInfinity : std::abs(1.0 / y.slope);
  double next_x = x.first_time(cell.x);
  double next_y = y.first_time(cell.y);
  std::ptrdiff_t at = static_cast<std::ptrdiff_t>(geometry_.index(cell));
  const std::ptrdiff_t row_step = y.step() * static_cast<std::ptrdiff_t>(geometry_.width);
  while (true) {
    const bool along_x = next_x < next_y;
    if ((along_x ? next_x : next_y) > leave) return std::nullopt;
    if (along_x) {
      next_x += dx;
      cell.x += x.step();
      at += x.step();
      if (cell.x < 0 || cell.x >= geometry_.width) return std::nullopt;
    } else {
      next_y += dy;
      cell.y += y.step();
      at += row_step;
      if (cell.y < 0 || cell.y >= geometry_.height) return std::nullopt;
    }
    if (blocked_[static_cast<std::size_t>(at)] == 0) continue;
    // From the index of the face, free of the steps' accumulated rounding.
    const double range = along_x ? x.time_at(x.step() > 0 ? cell.x : cell.x + 1)
                                 : y.time_at(y.step() > 0 ? cell.y : cell.y + 1);
    if (range > max_range) return std::nullopt;
    return RayHit{std::max(range, 0.0), cell, along_x};
  }
}

std::optional<double> intersect_disc(const Eigen::Vector2d& origin,
                                     const Eigen::Vector2d& direction,
                                     const Eigen::Vector2d& center, double radius) {
  const Eigen::Vector2d to_center = center - origin;
  const double along = to_center.dot(direction);
  const double outside = to_center.squaredNorm() - radius * radius;
  if (outside <= 0.0) return 0.0;
  if (along <= 0.0) return std::nullopt;
  const double discriminant = along * along - outside;
  if (discriminant < 0.0) return std::nullopt;
  return along - std::sqrt(discriminant);
}

}  // namespace coop::world
