#pragma once
#include "core/world/state.hpp"

namespace coop::test {

/// A room of free floor from (0, 0), in cells of 0.1 m, with walls of one cell around it.
inline world::World room(int width, int height) {
  world::World world;
  world.grid = OccupancyGrid({width + 2, height + 2, 0.1, {-0.1, -0.1}}, kOccupied);
  for (int y = 1; y <= height; ++y) {
    for (int x = 1; x <= width; ++x) world.grid[{x, y}] = kFree;
  }
  return world;
}

}  // namespace coop::test
