// Hundreds of eggs, one at a time: global planner and dwa drive a simulated base to each. Prints a
// line for every run that failed, with its seed, and the totals.
//   navigation_experiment [--runs N] [--first SEED] [--noise] [--refresh] [--paper] [--obstacles N]
//   [--pictures DIR] [--all]
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "core/config/config.hpp"
#include "experiments/navigation/closed_loop.hpp"
#include "experiments/navigation/picture.hpp"

namespace {

using namespace coop;
using namespace coop::test;

struct Arguments {
  int runs = 200;
  int first = 1;
  int obstacles = 0;
  bool all_pictures = false;
  bool verbose = false;
  std::string pictures;
  ClosedLoopConfig config;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  config::Document document;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto next = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    if (word == "--runs") {
      arguments.runs = std::stoi(next());
    } else if (word == "--first") {
      arguments.first = std::stoi(next());
    } else if (word == "--obstacles") {
      arguments.obstacles = std::stoi(next());
    } else if (word == "--pictures") {
      arguments.pictures = next();
    } else if (word == "--all-pictures") {
      arguments.all_pictures = true;
    } else if (word == "--verbose") {
      arguments.verbose = true;
    } else if (word == "--noise") {
      document.set("position_noise=0.02");
      document.set("heading_noise=0.01");
      document.set("range_noise=0.01");
    } else if (word == "--refresh") {
      document.set("goal_refresh_period=1.0");
      document.set("goal_refresh_noise=0.01");
    } else if (word == "--set") {
      document.set(next());
    } else {
      throw std::invalid_argument("unknown option " + word);
    }
  }
  document.read(arguments.config);
  return arguments;
}

/// Discs of duck to bucket size on free floor, away from robot and egg.
void add_obstacles(ClosedLoopConfig& config, const EggTask& task, int count, RandomStream& random) {
  config.new_obstacles.clear();
  while (static_cast<int>(config.new_obstacles.size()) < count) {
    const Eigen::Vector2d at(random.uniform(0.5, 13.5), random.uniform(0.8, 8.2));
    if ((at - task.start.position()).norm() < 1.5 || (at - task.egg).norm() < 1.5) continue;
    config.new_obstacles.emplace_back(at.x(), at.y(), random.uniform(0.10, 0.25));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments = parse(argc, argv);
  const OccupancyGrid house = make_duck_house();
  const TaskSource tasks(house, {});
  int success = 0, first_goal = 0, collisions = 0, crushed = 0, plans = 0, changes = 0;
  double time = 0.0, driven = 0.0, dwa_cpu = 0.0, planner_cpu = 0.0;
  std::vector<double> along, beside, times;
  for (int i = 0; i < arguments.runs; ++i) {
    const auto seed = static_cast<std::uint64_t>(arguments.first + i);
    RandomStream random(seed, "task");
    const EggTask task = tasks.draw(random);
    add_obstacles(arguments.config, task, arguments.obstacles, random);
    const RunResult result = run_closed_loop(arguments.config, house, task, seed);
    success += result.success ? 1 : 0;
    first_goal += result.success && result.goals == 1 ? 1 : 0;
    collisions += result.collisions > 0 ? 1 : 0;
    crushed += result.ran_over_egg ? 1 : 0;
    plans += result.plans;
    changes += result.direction_changes;
    time += result.time;
    driven += result.driven;
    dwa_cpu += result.dwa_cpu;
    planner_cpu += result.planner_cpu;
    times.push_back(result.time);
    if (result.arrived) {
      along.push_back(std::abs(result.egg_in_base.x() - kWorkingPoint.x()));
      beside.push_back(std::abs(result.egg_in_base.y()));
    }
    const bool bad = !result.success || result.collisions > 0 || result.ran_over_egg;
    if (bad || arguments.verbose) {
      std::printf(
          "seed %d: %s%s%s time %.1f s driven %.2f m goals %d plans %d turns %d egg at (%.3f, "
          "%.3f) %s\n",
          static_cast<int>(seed), result.success ? "arrived" : "FAILED",
          result.collisions > 0 ? " COLLISION" : "", result.ran_over_egg ? " RAN OVER EGG" : "",
          result.time, result.driven, result.goals, result.plans, result.direction_changes,
          result.egg_in_base.x(), result.egg_in_base.y(), result.failure.c_str());
    }
    if (!arguments.pictures.empty() && (bad || arguments.all_pictures)) {
      draw_run(arguments.pictures + "/run_" + std::to_string(seed) + ".png", arguments.config,
               house, task, result);
    }
  }
  const auto percentile = [](std::vector<double>& values, double part) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  const double n = arguments.runs;
  std::printf(
      "success %d of %d (%.1f %%), with the first approach pose %d; runs with collision %d, egg "
      "run over %d\n",
      success, arguments.runs, 100.0 * success / n, first_goal, collisions, crushed);
  std::printf(
      "egg error along: median %.3f p95 %.3f max %.3f m; beside: median %.3f p95 %.3f max %.3f m\n",
      percentile(along, 0.5), percentile(along, 0.95), percentile(along, 1.0),
      percentile(beside, 0.5), percentile(beside, 0.95), percentile(beside, 1.0));
  std::printf(
      "time mean %.1f median %.1f p95 %.1f s; driven %.2f m; plans %.1f; changes of direction "
      "%.2f\n",
      time / n, percentile(times, 0.5), percentile(times, 0.95), driven / n, plans / n,
      changes / n);
  std::printf("processor: dwa %.1f %%, planner %.1f %% of a core\n", 100.0 * dwa_cpu / time,
              100.0 * planner_cpu / time);
  return success == arguments.runs && collisions == 0 ? 0 : 1;
}
