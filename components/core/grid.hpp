#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace coop {

/// Cell of a grid: x to the right (column), y upwards (row), as in nav_msgs/OccupancyGrid.
struct Cell {
  int x = 0;
  int y = 0;
  bool operator==(const Cell&) const = default;
};

/// Where a grid lies in its frame. The origin is the outer corner of cell (0, 0); grids are never
/// rotated.
struct GridGeometry {
  int width = 0;            ///< cells
  int height = 0;           ///< cells
  double resolution = 0.0;  ///< m a cell
  Eigen::Vector2d origin{0.0, 0.0};

  [[nodiscard]] bool contains(Cell cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < width && cell.y < height;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
  [[nodiscard]] Cell cell_at(std::size_t index) const {
    const auto w = static_cast<std::size_t>(width);
    return {static_cast<int>(index % w), static_cast<int>(index / w)};
  }
  /// Cell that holds the point; may lie outside the grid.
  [[nodiscard]] Cell cell_of(const Eigen::Vector2d& point) const {
    return {static_cast<int>(std::floor((point.x() - origin.x()) / resolution)),
            static_cast<int>(std::floor((point.y() - origin.y()) / resolution))};
  }
  [[nodiscard]] Eigen::Vector2d center_of(Cell cell) const {
    return {origin.x() + (cell.x + 0.5) * resolution, origin.y() + (cell.y + 0.5) * resolution};
  }
  bool operator==(const GridGeometry&) const = default;
};

/// Row-major values over a geometry.
template <class T>
struct Grid {
  GridGeometry geometry;
  std::vector<T> cells;

  Grid() = default;
  Grid(const GridGeometry& where, T value) : geometry(where), cells(where.size(), value) {}

  [[nodiscard]] T& operator[](Cell cell) { return cells[geometry.index(cell)]; }
  [[nodiscard]] const T& operator[](Cell cell) const { return cells[geometry.index(cell)]; }
  /// Value at the cell, or `outside` beyond the border.
  [[nodiscard]] T at_or(Cell cell, T outside) const {
    return geometry.contains(cell) ? cells[geometry.index(cell)] : outside;
  }
  bool operator==(const Grid&) const = default;
};

/// Occupancy in percent, 0 (free) to 100 (occupied), kUnknown where nothing is known.
using OccupancyGrid = Grid<std::int8_t>;
inline constexpr std::int8_t kUnknown = -1;
inline constexpr std::int8_t kFree = 0;
inline constexpr std::int8_t kOccupied = 100;

}  // namespace coop
