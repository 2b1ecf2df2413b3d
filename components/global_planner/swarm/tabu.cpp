#include "global_planner/swarm/tabu.hpp"

#include <limits>
#include <tuple>

namespace coop::global_planner::swarm {

void TabuConfig::describe(config::Fields& fields) {
  fields.integer("tenure", tenure, {.unit = "moves", .min = 1, .max = 1000000});
  fields.integer("walks", walks, {.min = 1, .max = 100000});
}

std::uint32_t Tabu::best_neighbour(const TraversalGrid& grid, std::uint32_t here, Cell goal,
                                   std::int64_t move) {
  // A free cell before a taboo one, then the nearer, then the lot.
  using Merit = std::tuple<std::int64_t, int, std::uint64_t>;
  Merit best{std::numeric_limits<std::int64_t>::max(), 0, 0};
  std::uint32_t chosen = here;
  for (const std::uint32_t offset : neighbour_offsets(grid)) {
    const std::uint32_t there = here + offset;
    if (grid.factor(there) >= TraversalGrid::kBlocked) continue;
    const std::int64_t still_taboo = std::max<std::int64_t>(0, taboo_until_[there] - move);
    const Merit merit{still_taboo, manhattan(grid.cell_at(there), goal), random_()};
    if (merit >= best) continue;
    best = merit;
    chosen = there;
  }
  return chosen;
}

bool Tabu::walk(const TraversalGrid& grid, std::uint32_t start, Cell goal) {
  const std::uint32_t to = grid.padded_index(goal);
  const auto limit = 4 * static_cast<std::int64_t>(grid.geometry().size());
  taboo_until_.assign(grid.padded_size(), 0);
  track_.assign(1, start);
  std::uint32_t here = start;
  for (std::int64_t move = 0; here != to && move < limit; ++move) {
    taboo_until_[here] = move + config_.tenure;
    const std::uint32_t next = best_neighbour(grid, here, goal, move);
    if (next == here) return false;
    here = next;
    track_.push_back(here);
  }
  return here == to;
}

Result<GridPath, SearchFailure> Tabu::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  if (const auto failure = check_ends(grid, start, goal)) return fail(*failure);
  best_.clear();
  for (int i = 0; i < config_.walks; ++i) {
    if (!walk(grid, grid.padded_index(start), goal)) continue;
    eraser_.erase(track_, grid.padded_size());
    if (best_.empty() || track_.size() < best_.size()) best_ = track_;
  }
  if (best_.empty()) return fail(SearchFailure::kNoPath);
  return path_of(grid, best_);
}

}  // namespace coop::global_planner::swarm
