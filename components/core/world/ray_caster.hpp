#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/grid.hpp"

namespace coop::world {

struct RayHit {
  double range = 0.0;          ///< m from the origin to the face of the cell that stops the ray
  Cell cell;                   ///< that cell
  bool vertical_face = false;  ///< the face is of constant x (the ray entered the cell along x)
};

/// Exact rays through a grid, whose occupied cells are squares: visits every cell the ray crosses,
/// one boundary at a time (Amanatides, Woo: A Fast Voxel Traversal Algorithm for Ray Tracing,
/// 1987). Unknown cells and everything beyond the border let the ray pass.
class RayCaster {
 public:
  explicit RayCaster(const OccupancyGrid& grid);

  /// First occupied cell within `max_range` along the unit vector `direction`; range 0 where the
  /// origin lies in one.
  [[nodiscard]] std::optional<RayHit> cast(const Eigen::Vector2d& origin,
                                           const Eigen::Vector2d& direction,
                                           double max_range) const;

  [[nodiscard]] bool occupied(Cell cell) const {
    return geometry_.contains(cell) && blocked_[geometry_.index(cell)] != 0;
  }
  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }

 private:
  GridGeometry geometry_;
  std::vector<std::uint8_t> blocked_;
};

/// Distance along the unit vector `direction` at which the ray enters the disc; 0 where the origin
/// lies inside; nothing where it misses or the disc lies behind.
[[nodiscard]] std::optional<double> intersect_disc(const Eigen::Vector2d& origin,
                                                   const Eigen::Vector2d& direction,
                                                   const Eigen::Vector2d& center, double radius);

}  // namespace coop::world
