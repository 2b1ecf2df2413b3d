#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/costmap/distance_transform.hpp"
#include "core/grid.hpp"

namespace coop {

/// How far each cell is from the nearest obstacle cell, up to a cap. Kept as squared cells:
/// comparing needs no root.
class DistanceField {
 public:
  /// Measures anew from `obstacles` (0 or 1 a cell). Distances end at `max_distance` metres.
  void update(const GridGeometry& geometry, std::span<const std::uint8_t> obstacles,
              double max_distance) {
    geometry_ = geometry;
    squared_.resize(geometry.size());
    const double cap = std::ceil(max_distance / geometry.resolution);
    cap_ = cap < DistanceTransform::kNoCap ? std::max(1, static_cast<int>(cap))
                                           : DistanceTransform::kNoCap;
    transform_.run(obstacles, geometry.width, geometry.height, squared_, cap_);
  }

  /// After update(), where obstacles have changed within the windows only: the same field as
  /// update() would give, to the bit. Returns what was measured anew, valid until the next call.
  std::span<const CellRun> update_within(std::span<const CellWindow> changed,
                                         std::span<const std::uint8_t> obstacles) {
    return transform_.update(obstacles, changed, squared_);
  }

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] int cap() const { return cap_; }  ///< cells
  [[nodiscard]] std::span<const std::int32_t> squared_cells() const { return squared_; }

  /// Squared distance in cells; 0, as within an obstacle, beyond the border.
  [[nodiscard]] std::int32_t squared_at(Cell cell) const {
    return geometry_.contains(cell) ? squared_[geometry_.index(cell)] : 0;
  }
  /// Metres from the centre of the cell that holds the point.
  [[nodiscard]] double distance_at(const Eigen::Vector2d& point) const {
    return std::sqrt(static_cast<double>(squared_at(geometry_.cell_of(point)))) *
           geometry_.resolution;
  }

 private:
  GridGeometry geometry_;
  int cap_ = 1;
  std::vector<std::int32_t> squared_;
  DistanceTransform transform_;
};

}  // namespace coop
