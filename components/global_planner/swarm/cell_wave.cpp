#include "global_planner/swarm/cell_wave.hpp"

#include <limits>

namespace coop::global_planner::swarm {

bool CellWave::spread(const TraversalGrid& grid, std::uint32_t goal, std::uint32_t start) {
  const auto offsets = neighbour_offsets(grid);
  const Cost* cells = grid.cells().data();
  const float* factors = grid.factors().data();
  cost_.assign(grid.padded_size(), std::numeric_limits<float>::infinity());
  waiting_.assign(grid.padded_size(), 0);
  cost_[goal] = 0.0F;
  front_.assign(1, goal);
  // No step costs less than one: what waits in generation n costs at least n.
  for (generations_ = 0; !front_.empty() && !(cost_[start] <= static_cast<float>(generations_));
       ++generations_) {
    next_.clear();
    for (const std::uint32_t here : front_) waiting_[here] = 0;
    for (const std::uint32_t here : front_) {
      const float half = cost_[here] + 0.5F * factors[cells[here]];
      for (const std::uint32_t offset : offsets) {
        const std::uint32_t there = here + offset;
        // An infinite factor makes the cost infinite, which never is below the old one.
        const float cost = half + 0.5F * factors[cells[there]];
        if (!(cost < cost_[there])) continue;
        cost_[there] = cost;
        if (waiting_[there] != 0) continue;
        waiting_[there] = 1;
        next_.push_back(there);
      }
    }
    front_.swap(next_);
  }
  return cost_[start] < std::numeric_limits<float>::infinity();
}

}  // namespace coop::global_planner::swarm
