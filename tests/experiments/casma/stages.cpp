#include "experiments/casma/stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <mutex>
#include <thread>

#include "global_planner/swarm/four_way.hpp"
#include "global_planner/swarm/step_search.hpp"

namespace coop::casma {
namespace {

using global_planner::swarm::Objective;
using global_planner::swarm::StepSearch;
using global_planner::swarm::Track;
using global_planner::swarm::turns_of;

class Rosenbrock final : public Objective {
 public:
  [[nodiscard]] std::span<const double> lower() const override { return kLower; }
  [[nodiscard]] std::span<const double> upper() const override { return kUpper; }
  [[nodiscard]] double operator()(std::span<const double> x) override {
    return rosenbrock({x[0], x[1]});
  }

 private:
  static constexpr std::array<double, 2> kLower{-2.048, -2.048};
  static constexpr std::array<double, 2> kUpper{2.048, 2.048};
};

int turns_in(const std::vector<Cell>& path, const TraversalGrid& grid) {
  Track track;
  for (const Cell cell : path) track.push_back(grid.padded_index(cell));
  return turns_of(track);
}

}  // namespace

void run_all(const std::string& stage, std::size_t count, const StageOptions& options,
             const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr problem;
  const auto worker = [&] {
    while (options.stop == nullptr || !options.stop->load()) {
      const std::size_t i = next.fetch_add(1);
      if (i >= count) return;
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        problem = std::current_exception();
        next = count;
        return;
      }
      const std::lock_guard lock(mutex);
      ++done;
      if (options.progress) options.progress(stage, done, count);
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < options.jobs; ++i) others.emplace_back(worker);
  worker();
  others.clear();
  if (problem) std::rethrow_exception(problem);
}

double thread_time_us() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

double rosenbrock(const std::vector<double>& x) {
  const double valley = x[1] - x[0] * x[0];
  const double away = x[0] - 1.0;
  return 100.0 * valley * valley + away * away;
}

std::vector<RosenbrockRun> run_rosenbrock(const StageOptions& options) {
  const std::vector<Searcher> all = searchers();
  std::vector<RosenbrockRun> runs(all.size() * kRosenbrockRuns);
  run_all("Rosenbrock", runs.size(), options, [&](std::size_t i) {
    RosenbrockRun& run = runs[i];
    run.searcher = i / kRosenbrockRuns;
    const Searcher& searcher = all[run.searcher];
    RandomStream random(options.first_seed + i % kRosenbrockRuns, searcher.name);
    Rosenbrock objective;
    const double begin = thread_time_us();
    const auto minimum = searcher.make()->minimise(objective, random, &run.course);
    run.time_us = thread_time_us() - begin;
    run.place = minimum.place;
    run.value = minimum.value;
  });
  return runs;
}

std::vector<PlanRun> run_maps(const Paper& paper, const StageOptions& options) {
  const std::vector<Contender> all = contenders();
  const auto seeds = static_cast<std::size_t>(options.seeds);
  std::vector<Grid<Cost>> pens;
  std::vector<TraversalGrid> grids;
  for (const PaperMap& map : paper.maps) {
    pens.push_back(pen_with(paper.width, paper.height, map.pig_squares()));
    grids.emplace_back().update(pens.back());
  }
  std::vector<PlanRun> runs(paper.maps.size() * all.size() * seeds);
  run_all("maps 1 to 3", runs.size(), options, [&](std::size_t i) {
    PlanRun& run = runs[i];
    run.map = i / seeds / all.size();
    run.contender = i / seeds % all.size();
    run.seed = options.first_seed + i % seeds;
    const PaperMap& map = paper.maps[run.map];
    const auto planner = all[run.contender].make(run.seed);
    const double begin = thread_time_us();
    auto path = planner->plan(grids[run.map], map.start_cell(), map.goal_cell());
    run.time_us = thread_time_us() - begin;
    if (!path) return;
    run.found = true;
    run.path = std::move(path->cells);
    run.check = check_path(run.path, pens[run.map], map.start_cell(), map.goal_cell());
    run.turns = turns_in(run.path, grids[run.map]);
  });
  return runs;
}

int fewest_cells(const Grid<Cost>& pen, Cell start, Cell goal) {
  TraversalGrid grid;
  grid.update(pen);
  const auto path = StepSearch(StepSearch::Guidance::kNone).plan(grid, start, goal);
  return path ? static_cast<int>(path->cells.size()) : 0;
}

MovingRun run_moving_trial(const Paper& paper, std::size_t map, GridPlanner& planner,
                           std::uint64_t seed) {
  const PaperMap& place = paper.maps[map];
  const Cell goal = place.goal_cell();
  // Twelve pigs on every map, of the sizes on the third.
  std::vector<int> sizes;
  for (const Pig& pig : paper.maps.back().pig_squares()) sizes.push_back(pig.size);
  RandomStream random(seed, "moving pigs");
  Cell robot = place.start_cell();
  std::vector<Pig> pigs = place_pigs(paper.width, paper.height, sizes, {robot, goal}, random);
  Grid<Cost> pen = pen_with(paper.width, paper.height, pigs);
  TraversalGrid grid;
  MovingRun run;
  run.map = map;
  run.seed = seed;
  for (int tick = 0; robot != goal && tick < kMostTicks; ++tick) {
    draw_pigs(pen, pigs);
    if (pen[robot] == kLethalCost) ++run.touched;
    grid.update(pen);
    const double begin = thread_time_us();
    const auto path = planner.plan(grid, robot, goal);
    run.time_us += thread_time_us() - begin;
    ++run.plans;
    if (path) {
      robot = path->cells.at(1);
      ++run.steps;
    } else {
      ++run.waits;
    }
    walk(pigs, paper.width, paper.height, robot, kPigReach, random);
  }
  run.arrived = robot == goal;
  return run;
}

std::vector<MovingRun> run_moving(const Paper& paper, const StageOptions& options) {
  const std::vector<Contender> all = moving_contenders();
  const auto seeds = static_cast<std::size_t>(options.seeds);
  std::vector<MovingRun> runs;
  for (std::size_t map = 0; map < paper.maps.size(); ++map) {
    for (std::size_t contender = 0; contender < all.size(); ++contender) {
      const std::size_t stride = all[contender].name == "CASMA paper" ? kSlowStride : 1;
      for (std::size_t i = 0; i < seeds; i += stride) {
        runs.push_back({.map = map, .contender = contender, .seed = options.first_seed + i});
      }
    }
  }
  run_all("moving pigs", runs.size(), options, [&](std::size_t i) {
    const std::size_t contender = runs[i].contender;
    const auto planner = all[contender].make(runs[i].seed);
    runs[i] = run_moving_trial(paper, runs[i].map, *planner, runs[i].seed);
    runs[i].contender = contender;
  });
  return runs;
}

std::vector<PilotPlan> run_pilot(const Paper& paper, const StageOptions& options) {
  const std::vector<int> sizes(4, 3);
  const std::vector<Contender> all = contenders();
  const auto seeds = static_cast<std::size_t>(options.seeds);
  std::vector<PilotPlan> plans(paper.pilot.size() * seeds);
  run_all("pilot pen", plans.size(), options, [&](std::size_t i) {
    PilotPlan& result = plans[i];
    result.run = i / seeds;
    result.seed = options.first_seed + i % seeds;
    const PilotRun& task = paper.pilot[result.run];
    const Cell start{static_cast<int>(task.start[0]) - 1, static_cast<int>(task.start[1]) - 1};
    const Cell goal{static_cast<int>(task.goal[0]) - 1, static_cast<int>(task.goal[1]) - 1};
    RandomStream random(result.seed, "pilot pen");
    const Grid<Cost> pen =
        pen_with(kPilotWidth, kPilotHeight,
                 place_pigs(kPilotWidth, kPilotHeight, sizes, {start, goal}, random));
    result.fewest = std::max(0, fewest_cells(pen, start, goal) - 1);
    TraversalGrid grid;
    grid.update(pen);
    const auto best = all[0].make(result.seed);
    const double begin = thread_time_us();
    const auto path = best->plan(grid, start, goal);
    result.time_us = thread_time_us() - begin;
    if (path) result.steps = static_cast<int>(path->cells.size()) - 1;
    const auto literal = all[1].make(result.seed)->plan(grid, start, goal);
    if (literal) result.paper_method_steps = static_cast<int>(literal->cells.size()) - 1;
  });
  return plans;
}

}  // namespace coop::casma
