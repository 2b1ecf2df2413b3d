#pragma once
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/search/grid_planner.hpp"

namespace coop::global_planner::swarm {

/// Cells by their padded index in a TraversalGrid.
using Track = std::vector<std::uint32_t>;

/// From a padded index to its von Neumann neighbours: right, up, left, down. The CASMA paper's
/// robot moves to these only. The border of a TraversalGrid keeps them inside.
[[nodiscard]] inline std::array<std::uint32_t, 4> neighbour_offsets(const TraversalGrid& grid) {
  const auto up = static_cast<std::uint32_t>(grid.stride());
  return {1U, up, 0U - 1U, 0U - up};
}

/// Steps between two cells where nothing stands between them (the paper's equation 13).
[[nodiscard]] inline int manhattan(Cell a, Cell b) {
  return std::abs(a.x - b.x) + std::abs(a.y - b.y);
}

/// A track of neighbouring cells as path, cost in metres of free ground.
[[nodiscard]] GridPath path_of(const TraversalGrid& grid, std::span<const std::uint32_t> track);

/// Changes of direction along a track.
[[nodiscard]] int turns_of(std::span<const std::uint32_t> track);

/// Cuts loops out of tracks: what lies between two visits of the same cell goes, first come first
/// cut. Stays put where it repeats a cell. Keeps its work buffer.
class LoopEraser {
 public:
  /// `cells`: of the padded grid.
  void erase(Track& track, std::size_t cells);

 private:
  std::vector<std::uint32_t> place_;  ///< of a cell in the track so far, + 1; 0: not in it
};

}  // namespace coop::global_planner::swarm
