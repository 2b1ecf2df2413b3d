#include "experiments/casma/pen.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace coop::casma {
namespace {

int half(const Pig& pig) {
  return pig.size / 2;
}

bool inside(const Pig& pig, int width, int height) {
  return pig.middle.x - half(pig) >= 0 && pig.middle.y - half(pig) >= 0 &&
         pig.middle.x + half(pig) < width && pig.middle.y + half(pig) < height;
}

bool overlap(const Pig& a, const Pig& b) {
  const int apart = half(a) + half(b);
  return std::abs(a.middle.x - b.middle.x) <= apart && std::abs(a.middle.y - b.middle.y) <= apart;
}

}  // namespace

bool covers(const Pig& pig, Cell cell) {
  return std::abs(pig.middle.x - cell.x) <= half(pig) &&
         std::abs(pig.middle.y - cell.y) <= half(pig);
}

Grid<Cost> pen_with(int width, int height, const std::vector<Pig>& pigs) {
  Grid<Cost> pen({width, height, 1.0, {0.0, 0.0}}, kFreeCost);
  draw_pigs(pen, pigs);
  return pen;
}

void draw_pigs(Grid<Cost>& pen, const std::vector<Pig>& pigs) {
  std::ranges::fill(pen.cells, kFreeCost);
  for (const Pig& pig : pigs) {
    const int reach = half(pig);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Cell cell{pig.middle.x + dx, pig.middle.y + dy};
        if (pen.geometry.contains(cell)) pen[cell] = kLethalCost;
      }
    }
  }
}

PathCheck check_path(const std::vector<Cell>& path, const Grid<Cost>& pen, Cell start, Cell goal) {
  PathCheck check;
  check.cells = static_cast<int>(path.size());
  if (path.empty()) return check;
  check.at_start = path.front() == start;
  check.at_goal = path.back() == goal;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (pen.at_or(path[i], kLethalCost) == kLethalCost) ++check.pig_cells;
    if (i == 0) continue;
    const int moved = std::abs(path[i].x - path[i - 1].x) + std::abs(path[i].y - path[i - 1].y);
    if (moved == 0) ++check.repeats;
    if (moved > 1) ++check.jumps;
  }
  return check;
}

std::vector<Pig> place_pigs(int width, int height, const std::vector<int>& sizes,
                            const std::vector<Cell>& free_cells, RandomStream& random) {
  constexpr int kTries = 10000;
  std::vector<Pig> pigs;
  for (const int size : sizes) {
    bool placed = false;
    for (int i = 0; i < kTries && !placed; ++i) {
      const Pig pig{{static_cast<int>(random.below(static_cast<std::uint64_t>(width))),
                     static_cast<int>(random.below(static_cast<std::uint64_t>(height)))},
                    size};
      placed = inside(pig, width, height) &&
               std::ranges::none_of(free_cells, [&](Cell cell) { return covers(pig, cell); }) &&
               std::ranges::none_of(pigs, [&](const Pig& other) { return overlap(pig, other); });
      if (placed) pigs.push_back(pig);
    }
    if (!placed) throw std::runtime_error("no room in the pen for all pigs");
  }
  return pigs;
}

void walk(std::vector<Pig>& pigs, int width, int height, Cell robot, int reach,
          RandomStream& random) {
  static constexpr std::array<Cell, 4> kDirections{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  for (Pig& pig : pigs) {
    const Cell direction = kDirections.at(random.below(4));
    const auto distance = random.below(static_cast<std::uint64_t>(reach) + 1);
    for (std::uint64_t i = 0; i < distance; ++i) {
      const Pig moved{{pig.middle.x + direction.x, pig.middle.y + direction.y}, pig.size};
      const bool blocked = !inside(moved, width, height) || covers(moved, robot) ||
                           std::ranges::any_of(pigs, [&](const Pig& other) {
                             return &other != &pig && overlap(moved, other);
                           });
      if (blocked) break;
      pig = moved;
    }
  }
}

}  // namespace coop::casma
