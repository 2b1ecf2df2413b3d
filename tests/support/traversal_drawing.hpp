#pragma once
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "core/search/grid_planner.hpp"

namespace coop::test {

/// Draws a grid of 1 m cells; the first line is the top row. '.' free, '#' lethal, 'i' inscribed,
/// '?' unknown, a digit d a restricted cell of cost 28 d (9: the highest).
inline Grid<Cost> draw(const std::vector<std::string_view>& rows) {
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kFreeCost);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      Cost& cost = costs[{x, y}];
      if (c == '#') cost = kLethalCost;
      if (c == 'i') cost = kInscribedCost;
      if (c == '?') cost = kUnknownCost;
      if (c >= '1' && c <= '9') cost = static_cast<Cost>(28 * (c - '0'));
    }
  }
  return costs;
}

inline TraversalGrid make_grid(const Grid<Cost>& costs, const TraversalConfig& config = {}) {
  TraversalGrid grid(config);
  grid.update(costs);
  return grid;
}

/// A wall from below that ends one row before the top.
inline TraversalGrid grid_with_a_wall() {
  return make_grid(draw({".......",  //
                         "...#...",  //
                         "...#...",  //
                         "...#..."}));
}

/// Cells blocked with the given chance, the rest free, or of random cost where `weighted`.
inline Grid<Cost> random_costs(RandomStream& random, int width, int height, double blocked,
                               bool weighted) {
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kFreeCost);
  for (Cost& cost : costs.cells) {
    if (random.uniform() < blocked) {
      cost = kLethalCost;
    } else if (weighted && random.uniform() < 0.6) {
      cost = static_cast<Cost>(random.below(kMaxRestrictedCost + 1));
    }
  }
  return costs;
}

}  // namespace coop::test
