#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/search/grid_planner.hpp"
#include "core/search/tiles.hpp"

namespace coop {

/// Dijkstra's algorithm (the egg paper's global planner, section 2.3.2), run from the goal
/// outwards, so that one wave answers for every start.
///
/// The open list is an array of buckets one cell length wide. No step costs less than that, so
/// whatever lies in the lowest bucket is final in any order (Denardo, Fox 1979): no heap, no
/// sorting, and the costs are exact up to the rounding of floats. All arrays keep their size: a
/// query on a grid no larger than an earlier one allocates nothing.
class Dijkstra final : public GridPlanner {
 public:
  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

  /// The cost to the goal from every cell that is no dearer to reach from it than `limit` metres of
  /// free ground. Precondition: the goal is passable.
  void flood(const TraversalGrid& grid, Cell goal, double limit);
  /// As above, ending `slack` metres of free ground after `start` was reached.
  void flood_past(const TraversalGrid& grid, Cell goal, Cell start, double slack);

  /// After a flood: metres of free ground to the goal, infinite where the wave did not come. The
  /// grid must be the same.
  [[nodiscard]] double cost_to_goal(Cell cell) const;
  /// After a flood: the cheapest path from a cell the wave has reached.
  [[nodiscard]] GridPath path_from(const TraversalGrid& grid, Cell start) const;

 private:
  void prepare(const TraversalGrid& grid);
  void run(const TraversalGrid& grid, Cell goal, std::optional<Cell> start, double slack,
           double limit);
  void empty_bucket(const std::array<float, 256>& factors);
  [[nodiscard]] float cost_at(Cell cell) const { return cost_[tiles_.index(cell)]; }

  GridGeometry geometry_;
  search::Tiles tiles_;
  std::vector<float> cost_;  ///< cells of free ground, in tiles
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::uint32_t bucket_mask_ = 0;
  std::uint32_t current_ = 0;  ///< bucket being emptied
  std::size_t waiting_ = 0;    ///< entries in all buckets
};

}  // namespace coop
