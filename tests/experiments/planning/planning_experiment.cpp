/// Runs all scenarios of the MovingAI maps with every optimal grid planner: how many of the paths
/// have the published optimal length, and what a query costs. `planning_experiment [MAP...] [-o
/// DIR]` prints the table and leaves it in DIR as optimal.csv and report.html.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <set>

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/markup.hpp"
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

std::vector<std::filesystem::path> maps_of(const std::vector<std::string>& names) {
  const auto folder = test::shared_data("planning");
  std::set<std::filesystem::path> maps;
  for (const std::string& name : names) maps.insert(*folder / (name + ".map"));
  if (!names.empty()) return {maps.begin(), maps.end()};
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() == ".map") maps.insert(entry.path());
  }
  return {maps.begin(), maps.end()};
}

using Row = std::vector<std::string>;

void print(const Row& row) {
  std::cout << fmt::format("| {} |\n", fmt::join(row, " | ")) << std::flush;
}

void write_report(const std::filesystem::path& folder, const Row& headings,
                  const std::vector<Row>& rows, bool all_optimal) {
  std::string csv = csv_line(headings);
  for (const Row& row : rows) csv += csv_line(row);
  write_file_atomically(folder / "optimal.csv", csv);
  const std::string verdict =
      all_optimal ? "<p class=\"good\">Every path has the published length.</p>\n"
                  : "<p class=\"bad\">Not every path has the published length.</p>\n";
  write_file_atomically(folder / "report.html", html_page("Optimal planners on the MovingAI maps",
                                                          verdict + html_table(headings, rows)));
}

int run_all(const std::vector<std::string>& names, const std::string& folder) {
  if (!test::shared_data("planning")) {
    std::cerr << "not run: the shared planning data is absent\n";
    return 1;
  }
  std::vector<Contestant> contestants;
  contestants.push_back({"dijkstra", std::make_unique<Dijkstra>()});
  contestants.push_back({"astar", std::make_unique<AStar>()});
  contestants.push_back({"jump_point", std::make_unique<JumpPoint>()});
  Row headings{"map", "scenarios"};
  for (const Contestant& contestant : contestants) {
    headings.push_back(fmt::format("{} optimal", contestant.name));
    headings.push_back("us a query");
  }
  print(headings);
  print(Row(headings.size(), "---"));
  bool all_optimal = true;
  std::vector<Row> rows;
  for (const std::filesystem::path& map : maps_of(names)) {
    TraversalGrid grid;
    grid.update(test::read_moving_ai_map(map));
    const auto scenarios = test::read_scenarios(map.string() + ".scen");
    if (scenarios.empty()) throw std::runtime_error("no scenarios beside " + map.string());
    Row& row = rows.emplace_back(Row{map.stem().string(), std::to_string(scenarios.size())});
    for (const auto& [name, planner] : contestants) {
      const Score score = run(*planner, grid, scenarios);
      all_optimal = all_optimal && score.optimal == scenarios.size();
      row.push_back(std::to_string(score.optimal));
      row.push_back(fmt::format("{:.1f}", score.microseconds));
    }
    print(row);
  }
  if (!folder.empty()) write_report(folder, headings, rows, all_optimal);
  return all_optimal ? 0 : 1;
}

}  // namespace
}  // namespace coop

int main(int argc, char** argv) {
  std::vector<std::string> maps;
  std::string folder;
  CLI::App app{"Runs the scenarios of the MovingAI maps with every optimal grid planner.",
               "planning"};
  app.add_option("map", maps, "names of maps; all where none is given");
  app.add_option("-o,--output", folder, "folder of optimal.csv and report.html");
  CLI11_PARSE(app, argc, argv);
  try {
    return coop::run_all(maps, folder);
  } catch (const std::exception& error) {
    std::cerr << "planning_experiment: " << error.what() << '\n';
    return 1;
  }
}
