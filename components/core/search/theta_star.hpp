#pragma once
#include <cstdint>
#include <vector>

#include "core/search/grid_planner.hpp"

namespace coop {

/// Theta* (Nash, Daniel, Koenig, Felner 2007): A* whose path may run straight from any cell it
/// turns at to any cell that this one sees. The path's cells are its turns.
///
/// Two deviations: a straight line costs what it crosses (line_cost), so it also works on weighted
/// grids; and cells whose cost falls are expanded again, so the result is never dearer than the
/// optimal 8-connected path. It is not the optimal any-angle path: turns lie at cells, and a cell's
/// predecessor is sought only among those of its neighbours.
class ThetaStar final : public GridPlanner {
 public:
  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  struct Node {
    double cost = 0.0;         ///< from the start, cells of free ground
    std::uint32_t parent = 0;  ///< padded index of the cell the path comes straight from
    std::uint32_t query = 0;   ///< the query this belongs to: no other is valid
  };
  struct Entry {
    double estimate;  ///< cost + straight distance to the goal
    double cost;
    std::uint32_t index;
  };

  void prepare(const TraversalGrid& grid);
  bool search(const TraversalGrid& grid, Cell start, Cell goal);
  void expand(const TraversalGrid& grid, std::uint32_t index, Cell goal);
  void improve(const TraversalGrid& grid, std::uint32_t from, Cell next, double step, Cell goal);
  void reach(std::uint32_t index, double cost, std::uint32_t parent, double to_goal);
  [[nodiscard]] GridPath path(const TraversalGrid& grid, Cell start, Cell goal) const;

  std::vector<Node> nodes_;
  std::vector<Entry> open_;  ///< binary heap
  std::uint32_t query_ = 0;
};

}  // namespace coop
