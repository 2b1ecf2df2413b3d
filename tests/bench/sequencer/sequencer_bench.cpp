// What ordering costs: the matrix of path costs over a barn of 14 m x 9 m, and the two methods.
#include <benchmark/benchmark.h>

#include "core/random.hpp"
#include "sequencer/ant_colony.hpp"
#include "sequencer/held_karp.hpp"
#include "sequencer/path_costs.hpp"

namespace coop::sequencer {
namespace {

std::vector<Eigen::Vector2d> eggs(std::int64_t count) {
  RandomStream random(1, "eggs");
  std::vector<Eigen::Vector2d> places;
  for (std::int64_t i = 0; i < count; ++i) {
    places.emplace_back(random.uniform(1, 13), random.uniform(1, 8));
  }
  return places;
}

PathCosts barn() {
  OccupancyGrid costmap({280, 180, 0.05, {0, 0}}, kFree);
  for (int y = 0; y < 120; ++y) costmap[{140, y}] = kOccupied;
  PathCosts costs(Footprint({{-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}}),
                  TraversalConfig{});
  costs.set_costmap(costmap);
  return costs;
}

void Matrix(benchmark::State& state) {
  PathCosts costs = barn();
  const auto places = eggs(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(costs.matrix({1, 1, 0}, places));
}

void AntColony(benchmark::State& state) {
  PathCosts costs = barn();
  const CostMatrix matrix = costs.matrix({1, 1, 0}, eggs(state.range(0)));
  RandomStream random(1, "ants");
  for (auto _ : state) benchmark::DoNotOptimize(solve_by_ant_colony(matrix, {}, random));
}

void Exact(benchmark::State& state) {
  PathCosts costs = barn();
  const CostMatrix matrix = costs.matrix({1, 1, 0}, eggs(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(solve_exactly(matrix, false));
}

BENCHMARK(Matrix)->Arg(5)->Arg(12)->Iterations(10)->Unit(benchmark::kMillisecond);
BENCHMARK(AntColony)->Arg(5)->Arg(12)->Iterations(10)->Unit(benchmark::kMillisecond);
BENCHMARK(Exact)->Arg(5)->Arg(12)->Iterations(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::sequencer
