#pragma once
#include <cstdint>
#include <vector>

#include "global_planner/swarm/four_way.hpp"

namespace coop::global_planner::swarm {

/// Exact search for the fewest steps up, down, left and right; what a cell costs beyond a step
/// plays no part.
///
/// With guidance this is A* with the Manhattan distance, without it Dijkstra's algorithm. As all
/// steps are equal, a step either keeps the estimate of the whole path or raises it by two (by one
/// without guidance): the open list is two stacks.
class StepSearch final : public GridPlanner {
 public:
  enum class Guidance : std::uint8_t { kNone, kManhattan };
  explicit StepSearch(Guidance guidance) : guidance_(guidance) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;
  /// Of the last query: cells whose neighbours were looked at.
  [[nodiscard]] std::size_t expanded() const { return expanded_; }

 private:
  void search(const TraversalGrid& grid, std::uint32_t start, Cell goal);

  Guidance guidance_;
  std::vector<std::int32_t> steps_;   ///< from the start, negative: not reached
  std::vector<std::uint8_t> closed_;  ///< 1: its steps are final
  std::vector<std::uint32_t> parent_;
  Track current_;  ///< cells whose estimate is the lowest
  Track next_;     ///< those a level above
  Track track_;
  std::size_t expanded_ = 0;
};

}  // namespace coop::global_planner::swarm
