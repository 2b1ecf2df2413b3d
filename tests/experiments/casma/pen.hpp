#pragma once
#include <vector>

#include "core/costmap/costmap.hpp"
#include "core/random.hpp"
#include "experiments/casma/paper_data.hpp"

namespace coop::casma {

/// Whether the pig's square covers the cell.
[[nodiscard]] bool covers(const Pig& pig, Cell cell);

/// A pen of unit cells in which cells under a pig are lethal. What of a pig lies outside is cut.
[[nodiscard]] Grid<Cost> pen_with(int width, int height, const std::vector<Pig>& pigs);
/// The same into a grid that is there; keeps its memory.
void draw_pigs(Grid<Cost>& pen, const std::vector<Pig>& pigs);

/// What a path does that it must not.
struct PathCheck {
  int cells = 0;
  int pig_cells = 0;      ///< cells of the path under a pig, counted as often as it is in them
  int jumps = 0;          ///< neighbours in the path that are no neighbours in the pen
  int repeats = 0;        ///< steps that stay in their cell
  bool at_start = false;  ///< begins in the start cell
  bool at_goal = false;   ///< ends in the goal cell
  [[nodiscard]] bool sound() const {
    return pig_cells == 0 && jumps == 0 && repeats == 0 && at_start && at_goal;
  }
};
[[nodiscard]] PathCheck check_path(const std::vector<Cell>& path, const Grid<Cost>& pen, Cell start,
                                   Cell goal);

/// Pigs of the given sizes at random places wholly inside, not over `free_cells` and not over one
/// another. Throws std::runtime_error where no room is found.
[[nodiscard]] std::vector<Pig> place_pigs(int width, int height, const std::vector<int>& sizes,
                                          const std::vector<Cell>& free_cells,
                                          RandomStream& random);

/// Every pig walks in one of the four directions, drawn evenly, up to `reach` cells, the number
/// drawn evenly from 0 to `reach`; it stops before the fence, before the robot's cell and before
/// another pig.
void walk(std::vector<Pig>& pigs, int width, int height, Cell robot, int reach,
          RandomStream& random);

}  // namespace coop::casma
