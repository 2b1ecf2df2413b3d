#include <benchmark/benchmark.h>

#include <limits>
#include <optional>

#include "core/random.hpp"
#include "core/search/a_star.hpp"
#include "core/search/dijkstra.hpp"
#include "core/search/jump_point.hpp"
#include "core/search/theta_star.hpp"
#include "support/moving_ai.hpp"
#include "support/warehouse.hpp"

namespace coop {
namespace {

struct Pair {
  Cell start;
  Cell goal;
};

/// Random pairs of cells of the warehouse that a path joins.
std::vector<Pair> random_pairs(const TraversalGrid& grid, std::size_t count) {
  RandomStream random(1, "planners_bench");
  const GridGeometry& geometry = grid.geometry();
  std::vector<Pair> pairs;
  Dijkstra dijkstra;
  while (pairs.size() < count) {
    const Cell start = geometry.cell_at(random.below(geometry.size()));
    const Cell goal = geometry.cell_at(random.below(geometry.size()));
    if (dijkstra.plan(grid, start, goal)) pairs.push_back({start, goal});
  }
  return pairs;
}

/// Mean of 50 random pairs: an iteration is one of them, and all take part equally.
template <class Planner>
void BM_WarehousePairs(benchmark::State& state) {
  const Costmap* costmap = test::warehouse();
  if (costmap == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  constexpr std::size_t kPairs = 50;
  const bool weighted = state.range(0) != 0;
  TraversalGrid grid({.restricted_weight = weighted ? 6.0 : 0.0});
  grid.update(costmap->costs());
  const std::vector<Pair> pairs = random_pairs(grid, kPairs);
  Planner planner;
  for (auto _ : state) {
    for (const Pair& pair : pairs) {
      auto path = planner.plan(grid, pair.start, pair.goal);
      benchmark::DoNotOptimize(path);
    }
  }
  state.counters["ms_a_pair"] = benchmark::Counter(
      kPairs * 1e-3, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_WarehousePairs<Dijkstra>)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_WarehousePairs<AStar>)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_WarehousePairs<JumpPoint>)->Arg(0)->Unit(benchmark::kMillisecond);

/// Mean over all scenarios of maps of the MovingAI benchmark.
void BM_MovingAiJumpPoint(benchmark::State& state, const std::vector<const char*>& maps) {
  struct Problem {
    TraversalGrid grid;
    std::vector<test::Scenario> scenarios;
    JumpPoint planner{};
  };
  std::vector<Problem> problems;
  std::size_t queries = 0;
  for (const std::string name : maps) {
    const auto map = test::shared_data("planning/" + name + ".map");
    if (!map) {
      state.SkipWithError("not run: shared planning data is absent");
      return;
    }
    Problem problem{TraversalGrid(), test::read_scenarios(map->string() + ".scen")};
    problem.grid.update(test::read_moving_ai_map(*map));
    queries += problem.scenarios.size();
    problems.push_back(std::move(problem));
  }
  for (auto _ : state) {
    for (Problem& problem : problems) {
      for (const test::Scenario& scenario : problem.scenarios) {
        auto path = problem.planner.plan(problem.grid, scenario.start, scenario.goal);
        benchmark::DoNotOptimize(path);
      }
    }
  }
  state.counters["us_a_query"] = benchmark::Counter(
      static_cast<double>(queries) * 1e-6,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(BM_MovingAiJumpPoint, orz900d, {"orz900d"})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_MovingAiJumpPoint, dao, {"arena", "den312d", "brc202d", "orz900d"})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_MovingAiJumpPoint, city, {"Berlin_0_512", "Boston_0_512"})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop
