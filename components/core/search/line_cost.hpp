#pragma once
#include <cstdint>
#include <limits>

#include "core/search/grid_planner.hpp"

namespace coop {

/// What the straight line between the centres of two passable cells costs, in cells of free ground:
/// the length in each cell it crosses times that cell's factor, exactly (for neighbours this is
/// what a step costs). Infinite where the line enters a blocked cell or passes between two cells
/// that touch at a corner and are not both passable; and where the cost exceeds `limit`.
[[nodiscard]] double line_cost(const TraversalGrid& grid, Cell from, Cell to,
                               double limit = std::numeric_limits<double>::infinity());

}  // namespace coop
