#include <benchmark/benchmark.h>

#include <limits>

#include "core/costmap/costmap.hpp"
#include "core/map/map_file.hpp"
#include "core/search/dijkstra.hpp"
#include "support/shared_data.hpp"

namespace coop {
namespace {

/// A warehouse of 1006 x 1674 cells of 5 cm as a costmap.
const Costmap* warehouse() {
  static const Costmap* costmap = []() -> const Costmap* {
    const auto path = test::shared_data("maps/warehouse/warehouse.yaml");
    if (!path) return nullptr;
    const OccupancyGrid map = map::load_map(*path);
    auto* result = new Costmap({}, 0.28);
    result->reset(map.geometry);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      result->obstacles()[i] = map.cells[i] >= 65 ? 1 : 0;
      result->unknown()[i] = map.cells[i] < 0 ? 1 : 0;
    }
    result->update();
    return result;
  }();
  return costmap;
}

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
  const Costmap* costmap = warehouse();
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

void BM_CostmapFromScratch(benchmark::State& state) {
  const Costmap* source = warehouse();
  if (source == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  Costmap costmap({}, 0.28);
  for (auto _ : state) {
    costmap.reset(source->geometry());
    std::copy(source->obstacles().begin(), source->obstacles().end(), costmap.obstacles().begin());
    costmap.update();
    benchmark::DoNotOptimize(costmap.costs().cells.data());
  }
}
BENCHMARK(BM_CostmapFromScratch)->Unit(benchmark::kMillisecond);

void BM_DistanceTransform(benchmark::State& state) {
  const Costmap* source = warehouse();
  if (source == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  DistanceTransform transform;
  std::vector<std::int32_t> squared(source->geometry().size());
  for (auto _ : state) {
    transform.run(source->obstacles(), source->geometry().width, source->geometry().height, squared,
                  static_cast<int>(state.range(0)));
    benchmark::DoNotOptimize(squared.data());
  }
}
BENCHMARK(BM_DistanceTransform)
    ->Arg(21)
    ->Arg(DistanceTransform::kNoCap)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop
