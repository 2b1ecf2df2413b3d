/// Runs all scenarios of the MovingAI maps with every optimal grid planner: how many of the paths
/// have the published optimal length, and what a query costs. `planning_experiment [MAP...]`
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <set>

#include "core/search/a_star.hpp"
#include "core/search/dijkstra.hpp"
#include "core/search/jump_point.hpp"
#include "support/moving_ai.hpp"
#include "support/shared_data.hpp"

namespace coop {
namespace {

struct Contestant {
  const char* name;
  std::unique_ptr<GridPlanner> planner;
};

struct Score {
  std::size_t optimal = 0;
  double microseconds = 0.0;  ///< of processor time, mean of a query
};

/// A valid 8-connected path without cut corners from the start to the goal.
bool is_valid(const TraversalGrid& grid, const GridPath& path, const test::Scenario& scenario) {
  if (!(path.cells.front() == scenario.start) || !(path.cells.back() == scenario.goal))
    return false;
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    const Cell a = path.cells[i - 1];
    const Cell b = path.cells[i];
    if (std::abs(a.x - b.x) > 1 || std::abs(a.y - b.y) > 1 || !grid.passable(b) ||
        !grid.passable({a.x, b.y}) || !grid.passable({b.x, a.y})) {
      return false;
    }
  }
  return true;
}

Score run(GridPlanner& planner, const TraversalGrid& grid,
          const std::vector<test::Scenario>& scenarios) {
  Score score;
  std::clock_t spent = 0;
  // What a planner derives from the grid is made at the first query and kept.
  static_cast<void>(planner.plan(grid, scenarios.front().start, scenarios.front().goal));
  for (const test::Scenario& scenario : scenarios) {
    const std::clock_t before = std::clock();
    const auto path = planner.plan(grid, scenario.start, scenario.goal);
    spent += std::clock() - before;
    if (path && is_valid(grid, *path, scenario) &&
        std::abs(path->cost - scenario.length) <= scenario.tolerance) {
      ++score.optimal;
    }
  }
  score.microseconds =
      1e6 * static_cast<double>(spent) / CLOCKS_PER_SEC / static_cast<double>(scenarios.size());
  return score;
}

std::vector<std::filesystem::path> maps_of(int count, char** names) {
  const auto folder = test::shared_data("planning");
  std::set<std::filesystem::path> maps;
  for (int i = 0; i < count; ++i) maps.insert(*folder / (std::string(names[i]) + ".map"));
  if (count > 0 || !folder) return {maps.begin(), maps.end()};
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() == ".map") maps.insert(entry.path());
  }
  return {maps.begin(), maps.end()};
}

int run_all(int count, char** names) {
  if (!test::shared_data("planning")) {
    std::cerr << "not run: the shared planning data is absent\n";
    return 1;
  }
  std::vector<Contestant> contestants;
  contestants.push_back({"dijkstra", std::make_unique<Dijkstra>()});
  contestants.push_back({"astar", std::make_unique<AStar>()});
  contestants.push_back({"jump_point", std::make_unique<JumpPoint>()});
  std::cout << "| map | scenarios |";
  for (const auto& [name, planner] : contestants) {
    std::cout << ' ' << name << " optimal | us a query |";
  }
  std::cout << "\n|---|---|"
            << "---|---|---|---|---|---|\n"
            << std::fixed << std::setprecision(1);
  bool all_optimal = true;
  for (const std::filesystem::path& map : maps_of(count, names)) {
    TraversalGrid grid;
    grid.update(test::read_moving_ai_map(map));
    const auto scenarios = test::read_scenarios(map.string() + ".scen");
    if (scenarios.empty()) throw std::runtime_error("no scenarios beside " + map.string());
    std::cout << "| " << map.stem().string() << " | " << scenarios.size() << " |";
    for (const auto& [name, planner] : contestants) {
      const Score score = run(*planner, grid, scenarios);
      all_optimal = all_optimal && score.optimal == scenarios.size();
      std::cout << ' ' << score.optimal << " | " << score.microseconds << " |" << std::flush;
    }
    std::cout << '\n';
  }
  return all_optimal ? 0 : 1;
}

}  // namespace
}  // namespace coop

int main(int argc, char** argv) {
  try {
    return coop::run_all(argc - 1, argv + 1);
  } catch (const std::exception& error) {
    std::cerr << "planning_experiment: " << error.what() << '\n';
    return 1;
  }
}
