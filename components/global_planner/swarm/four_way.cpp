#include "global_planner/swarm/four_way.hpp"

namespace coop::global_planner::swarm {

GridPath path_of(const TraversalGrid& grid, std::span<const std::uint32_t> track) {
  GridPath path;
  path.cells.reserve(track.size());
  for (const std::uint32_t index : track) path.cells.push_back(grid.cell_at(index));
  path.cost = cost_of(grid, path.cells);
  return path;
}

int turns_of(std::span<const std::uint32_t> track) {
  int turns = 0;
  for (std::size_t i = 2; i < track.size(); ++i) {
    if (track[i] - track[i - 1] != track[i - 1] - track[i - 2]) ++turns;
  }
  return turns;
}

void LoopEraser::erase(Track& track, std::size_t cells) {
  if (place_.size() < cells) place_.resize(cells, 0);
  std::size_t kept = 0;
  for (const std::uint32_t cell : track) {
    if (place_[cell] != 0) {
      const std::size_t back_to = place_[cell];
      for (std::size_t i = back_to; i < kept; ++i) place_[track[i]] = 0;
      kept = back_to;
      continue;
    }
    track[kept++] = cell;
    place_[cell] = static_cast<std::uint32_t>(kept);
  }
  track.resize(kept);
  for (const std::uint32_t cell : track) place_[cell] = 0;
}

}  // namespace coop::global_planner::swarm
