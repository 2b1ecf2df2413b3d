#include <benchmark/benchmark.h>

#include "experiments/casma/stages.hpp"

namespace coop::casma {
namespace {

/// A plan on one of the CASMA paper's maps by a planner that has planned before. The paper: 61 to
/// 97 ms for CASMA.
void plan_on(benchmark::State& state, const Contender& contender, std::size_t map) {
  const Paper paper = load_paper(COOP_SOURCE_DIR "/tests/experiments/casma/paper.yaml");
  const PaperMap& place = paper.maps.at(map);
  TraversalGrid grid;
  grid.update(pen_with(paper.width, paper.height, place.pig_squares()));
  const auto planner = contender.make(1);
  double cells = 0;
  for (auto _ : state) {
    const auto path = planner->plan(grid, place.start_cell(), place.goal_cell());
    if (path) cells = static_cast<double>(path->cells.size());
    benchmark::DoNotOptimize(cells);
  }
  state.counters["cells"] = cells;
}

const bool registered = [] {
  for (const Contender& contender : contenders()) {
    for (std::size_t map = 0; map < 3; ++map) {
      benchmark::RegisterBenchmark(
          ("BM_Plan/" + contender.name + "/map:" + std::to_string(map + 1)).c_str(),
          [contender, map](benchmark::State& state) { plan_on(state, contender, map); })
          ->Unit(benchmark::kMicrosecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace coop::casma
