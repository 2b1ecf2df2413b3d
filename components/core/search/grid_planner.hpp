#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
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

  /// Differs between any two grids, or states of one, that may differ in what can be asked of them;
  /// never 0. Planners keep by it what they have derived from a grid.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

 private:
  GridGeometry geometry_;
  std::vector<Cost> cells_;
  std::array<float, 256> factors_{};
  float largest_factor_ = 1.0F;
  std::vector<std::uint32_t> opened_;
  std::uint64_t revision_ = 0;
};

/// 8-connected path, start and goal included, and its cost in metres of free ground. An any-angle
/// planner gives the cells at which its path turns; consecutive ones see each other.
struct GridPath {
  std::vector<Cell> cells;
  double cost = 0.0;
};

enum class SearchFailure : std::uint8_t {
  kStartBlocked,
  kGoalBlocked,
  kNoPath,
  kStartOutside,
  kGoalOutside,
  kEmptyGrid,
  kCostsDiffer,  ///< the planner can only search grids whose passable cells all cost the same
};

/// For people.
[[nodiscard]] std::string_view to_string(SearchFailure failure);

/// The reason why no search from start to goal can succeed that shows at once.
[[nodiscard]] std::optional<SearchFailure> check_ends(const TraversalGrid& grid, Cell start,
                                                      Cell goal);

/// The cell a point lies in, for a plan's start or goal: nothing where it lies outside the grid or
/// is not finite.
[[nodiscard]] std::optional<Cell> cell_within(const GridGeometry& geometry,
                                              const Eigen::Vector2d& point);

/// What an 8-connected path costs, in metres of free ground.
[[nodiscard]] double cost_of(const TraversalGrid& grid, std::span<const Cell> path);

/// A search over a traversal grid. A step to one of the eight neighbours costs its length times the
/// mean factor of the two cells; a diagonal step needs both side cells passable (no cutting of
/// corners). Planners keep their work space from one query to the next.
class GridPlanner {
 public:
  virtual ~GridPlanner() = default;
  [[nodiscard]] virtual Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                             Cell goal) = 0;
};

}  // namespace coop
