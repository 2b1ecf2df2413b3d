#include "experiments/casma/coin_walk.hpp"

#include <utility>

namespace coop::casma {

bool CoinWalk::walk(const TraversalGrid& grid, Cell start, Cell goal) {
  Cell here = start;
  track_.assign(1, grid.padded_index(here));
  while (here != goal) {
    const Cell along_x{here.x + (here.x < goal.x ? 1 : -1), here.y};
    const Cell along_y{here.x, here.y + (here.y < goal.y ? 1 : -1)};
    const bool x_leads = here.x != goal.x && grid.passable(along_x);
    const bool y_leads = here.y != goal.y && grid.passable(along_y);
    if (!x_leads && !y_leads) return false;
    const bool takes_x = x_leads && (!y_leads || random_.below(2) == 0);
    here = takes_x ? along_x : along_y;
    track_.push_back(grid.padded_index(here));
  }
  return true;
}

Result<GridPath, SearchFailure> CoinWalk::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  for (int i = 0; i < walks_; ++i) {
    if (walk(grid, start, goal)) return global_planner::swarm::path_of(grid, track_);
  }
  return fail(SearchFailure::kNoPath);
}

}  // namespace coop::casma
