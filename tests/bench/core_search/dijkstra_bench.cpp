#include <benchmark/benchmark.h>

#include <limits>

#include "core/search/dijkstra.hpp"
#include "support/warehouse.hpp"

namespace coop {
namespace {

/// The free cell nearest to the middle of the map.
Cell middle_of(const TraversalGrid& grid) {
  const Cell middle{grid.geometry().width / 2, grid.geometry().height / 2};
  for (int reach = 0; reach < grid.geometry().width / 2; ++reach) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell cell{middle.x + dx, middle.y + reach};
      if (grid.passable(cell)) return cell;
    }
  }
  return middle;
}

void full_wave(benchmark::State& state, bool weighted) {
  const Costmap* costmap = test::warehouse();
  if (costmap == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  TraversalGrid grid({.restricted_weight = weighted ? 6.0 : 0.0});
  grid.update(costmap->costs());
  const Cell goal = middle_of(grid);
  Dijkstra dijkstra;
  for (auto _ : state) {
    dijkstra.flood(grid, goal, std::numeric_limits<double>::infinity());
    benchmark::DoNotOptimize(dijkstra.cost_to_goal(goal));
  }
  double reached = 0;
  for (std::size_t i = 0; i < costmap->geometry().size(); ++i) {
    if (dijkstra.cost_to_goal(costmap->geometry().cell_at(i)) < 1e9) reached += 1.0;
  }
  state.counters["cells_reached"] = reached;
}

void BM_DijkstraFullWaveWeighted(benchmark::State& state) {
  full_wave(state, true);
}
void BM_DijkstraFullWaveUnweighted(benchmark::State& state) {
  full_wave(state, false);
}
BENCHMARK(BM_DijkstraFullWaveWeighted)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_DijkstraFullWaveUnweighted)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop
