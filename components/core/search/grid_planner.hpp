#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/costmap/costmap.hpp"
#include "core/grid.hpp"
#include "core/result.hpp"

namespace coop {

/// What a step over a cell costs, as a multiple of its length: 1 on free cells, more in restricted
/// ones.
struct TraversalConfig {
  double restricted_weight = 6.0;  ///< extra cost of the most restricted cell, in lengths
  double unknown_weight = 3.0;     ///< extra cost of an unknown cell, in lengths
  bool allow_unknown = false;      ///< whether paths may lead through unknown cells

  void describe(config::Fields& fields);
};

/// A costmap made ready for searching: one byte a cell with a border of blocked cells all round, so
/// that a search needs no bounds check, and the factor of each byte. Lethal and inscribed cells are
/// blocked.
class TraversalGrid {
 public:
  static constexpr float kBlocked = std::numeric_limits<float>::infinity();

  explicit TraversalGrid(const TraversalConfig& config = {});

  void update(const Grid<Cost>& costs);

  /// Opens the inscribed cells within `radius` metres of the cell, at the highest price: a robot
  /// that stands in the inscribed zone must be able to leave it, and one whose goal lies there to
  /// enter. Undone by close().
  void open_around(Cell cell, double radius);
  void close();

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }  ///< without the border
  [[nodiscard]] int stride() const { return geometry_.width + 2; }
  [[nodiscard]] std::size_t padded_size() const { return cells_.size(); }
  [[nodiscard]] std::uint32_t padded_index(Cell cell) const {
    return static_cast<std::uint32_t>((cell.y + 1) * stride() + cell.x + 1);
  }
  [[nodiscard]] Cell cell_at(std::uint32_t padded) const {
    const auto index = static_cast<int>(padded);
    return {index % stride() - 1, index / stride() - 1};
  }
  [[nodiscard]] std::span<const Cost> cells() const { return cells_; }
  [[nodiscard]] const std::array<float, 256>& factors() const { return factors_; }
  [[nodiscard]] float factor(std::uint32_t padded) const { return factors_[cells_[padded]]; }
  [[nodiscard]] bool passable(Cell cell) const {
    return geometry_.contains(cell) && factor(padded_index(cell)) < kBlocked;
  }
  [[nodiscard]] float largest_factor() const { return largest_factor_; }

 private:
  GridGeometry geometry_;
  std::vector<Cost> cells_;
  std::array<float, 256> factors_{};
  float largest_factor_ = 1.0F;
  std::vector<std::uint32_t> opened_;
};

/// 8-connected path, start and goal included, and its cost in metres of free ground.
struct GridPath {
  std::vector<Cell> cells;
  double cost = 0.0;
};

enum class SearchFailure : std::uint8_t { kStartBlocked, kGoalBlocked, kNoPath };

/// A search over a traversal grid. A step to one of the eight neighbours costs its length times the
/// mean factor of the two cells; a diagonal step needs both side cells passable (no cutting of
/// corners).
class GridPlanner {
 public:
  virtual ~GridPlanner() = default;
  [[nodiscard]] virtual Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                             Cell goal) = 0;
};

}  // namespace coop
