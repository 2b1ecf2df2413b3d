#pragma once
#include <vector>

#include "global_planner/swarm/four_way.hpp"

namespace coop::global_planner::swarm {

/// Food's scent as a cellular automaton over von Neumann neighbourhoods: in each generation the
/// cells whose scent has risen pass it on, weakened by the cost of a step, and a cell keeps the
/// strongest it has met. Kept as the cost to the food, of which scent falls strictly. Exact when
/// the wave has ended; where all steps cost the same, generation n settles the cells n steps away.
class CellWave {
 public:
  /// Spreads from the goal until the start's cost is final or nothing changes any more. Whether the
  /// start was reached.
  bool spread(const TraversalGrid& grid, std::uint32_t goal, std::uint32_t start);

  /// In cells of free ground; infinite where the wave did not come. Final for all cells that cost
  /// no more than the start.
  [[nodiscard]] float cost(std::uint32_t cell) const { return cost_[cell]; }
  [[nodiscard]] int generations() const { return generations_; }

 private:
  std::vector<float> cost_;
  std::vector<std::uint8_t> waiting_;  ///< 1: in the next generation already
  Track front_;
  Track next_;
  int generations_ = 0;
};

}  // namespace coop::global_planner::swarm
