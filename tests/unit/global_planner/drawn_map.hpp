#pragma once
#include <string_view>
#include <vector>

#include "core/grid.hpp"

namespace coop::test {

/// A map of 5 cm cells drawn in blocks of 0.5 m; the first line is the top row, the lower left
/// corner is the origin.
/// '#' occupied, '?' unknown, anything else free.
inline OccupancyGrid draw_map(const std::vector<std::string_view>& rows) {
  constexpr int kCellsABlock = 10;
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  OccupancyGrid map({width * kCellsABlock, height * kCellsABlock, 0.05, {0.0, 0.0}}, kFree);
  for (int y = 0; y < map.geometry.height; ++y) {
    for (int x = 0; x < map.geometry.width; ++x) {
      const auto row = static_cast<std::size_t>(height - 1 - y / kCellsABlock);
      const char c = rows[row][static_cast<std::size_t>(x / kCellsABlock)];
      if (c == '#') map[{x, y}] = kOccupied;
      if (c == '?') map[{x, y}] = kUnknown;
    }
  }
  return map;
}

/// Of the egg collector.
inline const std::vector<Eigen::Vector2d> kRobotFootprint{
    {-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}};
inline constexpr double kTurningRadius = 0.80;  // m

/// An empty room of 6 m x 5 m with walls of 0.5 m around.
inline OccupancyGrid draw_room() {
  return draw_map({"############",  //
                   "#..........#",  //
                   "#..........#",  //
                   "#..........#",  //
                   "#..........#",  //
                   "#..........#",  //
                   "#..........#",  //
                   "#..........#",  //
                   "#..........#",  //
                   "############"});
}

}  // namespace coop::test
