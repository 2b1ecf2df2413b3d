#include "simulator/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/world/state.hpp"

namespace coop::simulator {
namespace {

using Eigen::Vector2d;

struct CellRange {
  Cell low;
  Cell high;  ///< inclusive
};

/// Cells that the rectangle touches, within the grid.
CellRange cells_of(const GridGeometry& geometry, const Vector2d& low, const Vector2d& high) {
  const Cell first = geometry.cell_of(low);
  const Cell last = geometry.cell_of(high);
  return {{std::max(first.x, 0), std::max(first.y, 0)},
          {std::min(last.x, geometry.width - 1), std::min(last.y, geometry.height - 1)}};
}

/// Whether the square lies wholly beyond one of the outline's edges.
bool separated_by_an_edge(std::span<const Vector2d> outline, const Vector2d& center, double half) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d edge = outline[(i + 1) % outline.size()] - a;
    const Vector2d outward(edge.y(), -edge.x());
    const double nearest =
        outward.dot(center - a) - half * (std::abs(outward.x()) + std::abs(outward.y()));
    if (nearest >= 0.0) return true;
  }
  return false;
}

double distance_to_cell(const GridGeometry& geometry, Cell cell, const Vector2d& point) {
  const Vector2d offset = (point - geometry.center_of(cell)).cwiseAbs();
  const double half = 0.5 * geometry.resolution;
  return std::hypot(std::max(offset.x() - half, 0.0), std::max(offset.y() - half, 0.0));
}

template <class Matches>
bool disc_touches(const Vector2d& center, double radius, const OccupancyGrid& grid,
                  const Matches& matches) {
  const Vector2d reach(radius, radius);
  const CellRange range = cells_of(grid.geometry, center - reach, center + reach);
  for (int y = range.low.y; y <= range.high.y; ++y) {
    for (int x = range.low.x; x <= range.high.x; ++x) {
      const Cell cell{x, y};
      if (matches(grid[cell]) && distance_to_cell(grid.geometry, cell, center) < radius)
        return true;
    }
  }
  return false;
}

}  // namespace

void place(std::span<const Vector2d> outline, const Pose2& pose, std::vector<Vector2d>& placed) {
  placed.resize(outline.size());
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  std::transform(outline.begin(), outline.end(), placed.begin(), [&](const Vector2d& p) {
    return Vector2d(pose.x + c * p.x() - s * p.y(), pose.y + s * p.x() + c * p.y());
  });
}

bool outline_hits_grid(std::span<const Vector2d> outline, const OccupancyGrid& grid) {
  Vector2d low = outline.front();
  Vector2d high = outline.front();
  for (const Vector2d& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double half = 0.5 * grid.geometry.resolution;
  const CellRange range = cells_of(grid.geometry, low, high);
  for (int y = range.low.y; y <= range.high.y; ++y) {
    for (int x = range.low.x; x <= range.high.x; ++x) {
      const Cell cell{x, y};
      if (!world::is_occupied(grid[cell])) continue;
      const Vector2d center = grid.geometry.center_of(cell);
      const bool apart = center.x() - half >= high.x() || center.x() + half <= low.x() ||
                         center.y() - half >= high.y() || center.y() + half <= low.y();
      if (!apart && !separated_by_an_edge(outline, center, half)) return true;
    }
  }
  return false;
}

double distance_to_outline(std::span<const Vector2d> outline, const Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d edge = outline[(i + 1) % outline.size()] - a;
    const Vector2d to_point = point - a;
    inside = inside && edge.x() * to_point.y() - edge.y() * to_point.x() >= 0.0;
    const double along = std::clamp(to_point.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (to_point - along * edge).norm());
  }
  return inside ? 0.0 : nearest;
}

bool disc_hits_grid(const Vector2d& center, double radius, const OccupancyGrid& grid) {
  return disc_touches(center, radius, grid,
                      [](std::int8_t value) { return world::is_occupied(value); });
}

bool disc_is_free(const Vector2d& center, double radius, const OccupancyGrid& grid) {
  const Vector2d reach(radius, radius);
  const Cell first = grid.geometry.cell_of(center - reach);
  const Cell last = grid.geometry.cell_of(center + reach);
  if (!grid.geometry.contains(first) || !grid.geometry.contains(last)) return false;
  return !disc_touches(center, radius, grid, [](std::int8_t value) {
    return value == kUnknown || world::is_occupied(value);
  });
}

}  // namespace coop::simulator
