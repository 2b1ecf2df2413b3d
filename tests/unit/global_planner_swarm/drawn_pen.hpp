#pragma once
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "core/search/grid_planner.hpp"

namespace coop::test {

/// A grid of 1 m cells; the first line is the top row. '#' lethal, a digit d a restricted cell of
/// cost 28 d, anything else free.
inline TraversalGrid draw_pen(const std::vector<std::string_view>& rows,
                              const TraversalConfig& config = {}) {
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kFreeCost);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      if (c == '#') costs[{x, y}] = kLethalCost;
      if (c >= '1' && c <= '9') costs[{x, y}] = static_cast<Cost>(28 * (c - '0'));
    }
  }
  TraversalGrid grid(config);
  grid.update(costs);
  return grid;
}

/// Cells blocked at random with the given share.
inline TraversalGrid random_pen(int width, int height, double share, RandomStream& random) {
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kFreeCost);
  for (Cost& cost : costs.cells) cost = random.uniform() < share ? kLethalCost : kFreeCost;
  TraversalGrid grid;
  grid.update(costs);
  return grid;
}

/// Whether each step goes to a passable von Neumann neighbour.
inline bool is_walkable(const TraversalGrid& grid, const std::vector<Cell>& path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!grid.passable(path[i])) return false;
    if (i == 0) continue;
    if (std::abs(path[i].x - path[i - 1].x) + std::abs(path[i].y - path[i - 1].y) != 1)
      return false;
  }
  return !path.empty();
}

}  // namespace coop::test
