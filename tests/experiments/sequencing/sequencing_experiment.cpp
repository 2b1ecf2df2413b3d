// sequencing_experiment [seeds]: how near the orders of collecting come to the optimum and how long
// they take, on TSPLIB instances (closed tours) and with eggs in the duck house (open tours over
// path costs). Processor time; tables as in docs/experiments/sequencing.md.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numeric>
#include <string>

#include "experiments/sequencing/duck_house_eggs.hpp"
#include "sequencer/held_karp.hpp"
#include "sequencer/ordering.hpp"
#include "support/shared_data.hpp"
#include "support/tsplib.hpp"

namespace coop::experiments {
namespace {

using namespace coop::sequencer;

/// Of one method over all seeds.
struct Scores {
  std::vector<double> costs;
  std::vector<double> milliseconds;
};

double milliseconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Scores score(int seeds, const std::function<Tour(RandomStream&)>& solve) {
  Scores scores;
  for (int seed = 1; seed <= seeds; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), "ants");
    Tour tour;
    scores.milliseconds.push_back(milliseconds_of([&] { tour = solve(random); }));
    scores.costs.push_back(tour.cost);
  }
  return scores;
}

void print_row(const std::string& name, double optimum, const Scores& scores) {
  const auto hits = std::ranges::count_if(
      scores.costs, [&](double cost) { return cost <= optimum * (1.0 + 1e-9); });
  std::printf("| %-18s | %3d of %d | %6.3f %% | %6.3f %% | %7.1f | %7.1f |\n", name.c_str(),
              static_cast<int>(hits), static_cast<int>(scores.costs.size()),
              100.0 * (mean(scores.costs) / optimum - 1.0),
              100.0 * (std::ranges::max(scores.costs) / optimum - 1.0), mean(scores.milliseconds),
              std::ranges::max(scores.milliseconds));
}

/// Fewer iterations: when the best method has its optimum.
MaxMinConfig shortened(int iterations) {
  MaxMinConfig config;
  config.iterations = iterations;
  return config;
}

void tsplib(const std::string& name, double optimum, int seeds) {
  auto path = test::shared_data("tsp/" + name + ".tsp");
  if (!path) path = std::filesystem::path(COOP_SOURCE_DIR) / "tests/data/tsp" / (name + ".tsp");
  if (!std::filesystem::exists(*path)) {
    std::printf("| %-18s | not run: no such file |\n", name.c_str());
    return;
  }
  const CostMatrix costs = test::load_tsplib(*path);
  for (const int iterations : {25, 50, 100}) {
    print_row(name + " best/" + std::to_string(iterations), optimum,
              score(seeds, [&](RandomStream& random) {
                return solve_by_max_min_ants(costs, true, shortened(iterations), random);
              }));
  }
  print_row(name + " best", optimum, score(seeds, [&](RandomStream& random) {
              return solve_by_max_min_ants(costs, true, {}, random);
            }));
  AntColonyConfig colony;
  colony.closed = true;
  print_row(name + " paper", optimum, score(seeds, [&](RandomStream& random) {
              return solve_by_ant_colony(costs, colony, random);
            }));
}

/// The cost of each order against the best known of that seed, and all the time it took.
void duck_house(std::size_t eggs, int seeds) {
  PathCosts paths = duck_house_costs();
  std::vector<double> matrix_time, best_time, paper_time, excess;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto places = duck_house_eggs(paths, eggs, static_cast<std::uint64_t>(seed));
    CostMatrix costs;
    matrix_time.push_back(milliseconds_of([&] { costs = paths.matrix(kDuckHouseStart, places); }));
    RandomStream random(static_cast<std::uint64_t>(seed), "ants");
    Tour best;
    Tour paper;
    best_time.push_back(milliseconds_of([&] {
      best = eggs <= kMaxExactTargets ? solve_exactly(costs, false)
                                      : solve_by_max_min_ants(costs, false, {}, random);
    }));
    paper_time.push_back(milliseconds_of([&] { paper = solve_by_ant_colony(costs, {}, random); }));
    excess.push_back(100.0 * (paper.cost / best.cost - 1.0));
  }
  std::printf("| %4zu | %6.1f (%.1f) | %6.1f (%.1f) | %6.1f (%.1f) | %.2f %% (%.2f %%) |\n", eggs,
              mean(matrix_time), std::ranges::max(matrix_time), mean(best_time),
              std::ranges::max(best_time), mean(paper_time), std::ranges::max(paper_time),
              mean(excess), std::ranges::max(excess));
}

void run(int seeds) {
  std::printf(
      "| instance, method   | optimum  | mean    | worst   | ms      | max ms "
      "|\n|---|---|---|---|---|---|\n");
  tsplib("eil51", 426, seeds);
  tsplib("berlin52", 7542, seeds);
  tsplib("st70", 675, seeds);
  tsplib("pr76", 108159, seeds);
  tsplib("kroA100", 21282, seeds);
  tsplib("a280", 2579, seeds);
  std::printf(
      "\n| eggs | matrix ms (max) | best ms (max) | paper ms (max) | paper dearer by (max) "
      "|\n|---|---|---|---|---|\n");
  for (const std::size_t eggs : {5U, 12U, 30U, 60U, 100U}) duck_house(eggs, seeds);
}

}  // namespace
}  // namespace coop::experiments

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 10;
  if (seeds < 1 || argc > 2) {
    std::fprintf(stderr, "usage: sequencing_experiment [seeds]\n");
    return 2;
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // each row as it comes, into a file too
  coop::experiments::run(seeds);
  return 0;
}
