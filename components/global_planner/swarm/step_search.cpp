#include "global_planner/swarm/step_search.hpp"

#include <algorithm>

namespace coop::global_planner::swarm {

Result<GridPath, SearchFailure> StepSearch::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  const std::uint32_t from = grid.padded_index(start);
  const std::uint32_t to = grid.padded_index(goal);
  search(grid, from, goal);
  if (closed_[to] == 0) return fail(SearchFailure::kNoPath);
  track_.clear();
  for (std::uint32_t cell = to; cell != from; cell = parent_[cell]) track_.push_back(cell);
  track_.push_back(from);
  std::ranges::reverse(track_);
  return path_of(grid, track_);
}

void StepSearch::search(const TraversalGrid& grid, std::uint32_t start, Cell goal) {
  const auto offsets = neighbour_offsets(grid);
  const Cost* cells = grid.cells().data();
  const float* factors = grid.factors().data();
  const std::uint32_t to = grid.padded_index(goal);
  steps_.assign(grid.padded_size(), -1);
  closed_.assign(grid.padded_size(), 0);
  parent_.resize(grid.padded_size());
  current_.assign(1, start);
  next_.clear();
  steps_[start] = 0;
  expanded_ = 0;
  while (!current_.empty()) {
    const std::uint32_t here = current_.back();
    current_.pop_back();
    if (closed_[here] == 0) {
      closed_[here] = 1;
      if (here == to) return;
      ++expanded_;
      const Cell cell = grid.cell_at(here);
      // Whether the step right, up, left or down comes nearer to the goal.
      const std::array<bool, 4> nearer{
          cell.x<goal.x, cell.y<goal.y, cell.x> goal.x, cell.y> goal.y};
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        const std::uint32_t cell_there = here + offsets[i];
        const std::int32_t steps = steps_[here] + 1;
        const bool known = steps_[cell_there] >= 0 && steps_[cell_there] <= steps;
        if (known || factors[cells[cell_there]] >= TraversalGrid::kBlocked) continue;
        steps_[cell_there] = steps;
        parent_[cell_there] = here;
        const bool same_level = guidance_ == Guidance::kManhattan && nearer[i];
        (same_level ? current_ : next_).push_back(cell_there);
      }
    }
    if (current_.empty()) current_.swap(next_);
  }
}

}  // namespace coop::global_planner::swarm
