#include "experiments/casma/turned.hpp"

namespace coop::casma {

Result<GridPath, SearchFailure> Turned::plan(const TraversalGrid& grid, Cell start, Cell goal) {
  const GridGeometry& geometry = grid.geometry();
  const auto turn = [&](Cell cell) {
    return Cell{geometry.width - 1 - cell.x, geometry.height - 1 - cell.y};
  };
  Grid<Cost> costs(geometry, kFreeCost);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    const Cell cell = geometry.cell_at(i);
    costs[turn(cell)] = grid.cells()[grid.padded_index(cell)];
  }
  TraversalGrid turned;
  turned.update(costs);
  auto path = planner_->plan(turned, turn(start), turn(goal));
  if (path) {
    for (Cell& cell : path->cells) cell = turn(cell);
  }
  return path;
}

}  // namespace coop::casma
