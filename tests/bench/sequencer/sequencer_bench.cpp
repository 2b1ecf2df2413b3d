// What ordering costs in the duck house: the matrix of path costs, and each method.
#include <benchmark/benchmark.h>

#include "experiments/sequencing/duck_house_eggs.hpp"
#include "sequencer/held_karp.hpp"
#include "sequencer/ordering.hpp"
#include "support/tsplib.hpp"

namespace coop::sequencer {
namespace {

using experiments::duck_house_costs;
using experiments::duck_house_eggs;
using experiments::kDuckHouseStart;

CostMatrix house_matrix(std::int64_t eggs) {
  PathCosts costs = duck_house_costs();
  return costs.matrix(kDuckHouseStart, duck_house_eggs(costs, static_cast<std::size_t>(eggs), 1));
}

void Matrix(benchmark::State& state) {
  PathCosts costs = duck_house_costs();
  const auto eggs = duck_house_eggs(costs, static_cast<std::size_t>(state.range(0)), 1);
  for (auto _ : state) benchmark::DoNotOptimize(costs.matrix(kDuckHouseStart, eggs));
}

void AntColony(benchmark::State& state) {
  const CostMatrix matrix = house_matrix(state.range(0));
  RandomStream random(1, "ants");
  for (auto _ : state) benchmark::DoNotOptimize(solve_by_ant_colony(matrix, {}, random));
}

void MaxMinAnts(benchmark::State& state) {
  const CostMatrix matrix = house_matrix(state.range(0));
  RandomStream random(1, "ants");
  for (auto _ : state) benchmark::DoNotOptimize(solve_by_max_min_ants(matrix, false, {}, random));
}

void Exact(benchmark::State& state) {
  const CostMatrix matrix = house_matrix(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(solve_exactly(matrix, false));
}

/// Path costs and the exact order, as the mission asks for them.
void MatrixAndExact(benchmark::State& state) {
  PathCosts costs = duck_house_costs();
  const auto eggs = duck_house_eggs(costs, static_cast<std::size_t>(state.range(0)), 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve_exactly(costs.matrix(kDuckHouseStart, eggs), false));
  }
}

void MaxMinAntsA280(benchmark::State& state) {
  const CostMatrix matrix = test::load_tsplib(COOP_SOURCE_DIR "/tests/data/tsp/a280.tsp");
  RandomStream random(1, "ants");
  for (auto _ : state) benchmark::DoNotOptimize(solve_by_max_min_ants(matrix, true, {}, random));
}

BENCHMARK(Matrix)->Arg(5)->Arg(12)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(AntColony)->Arg(5)->Arg(12)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(MaxMinAnts)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK(Exact)->Arg(5)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK(MatrixAndExact)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK(MaxMinAntsA280)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::sequencer
