#include <benchmark/benchmark.h>

#include "experiments/navigation/duck_house.hpp"
#include "global_planner/path_planner.hpp"
#include "global_planner/planning_map.hpp"

namespace coop::global_planner {
namespace {

/// Drivable plans for twenty tasks in the duck house, one after the other.
void BM_DrivablePlan(benchmark::State& state) {
  const OccupancyGrid house = test::make_duck_house();
  const test::ExperimentRobot robot;
  const test::TaskSource tasks(house, robot);
  const PathPlannerConfig config;
  PathPlanner planner(config, robot.footprint, 0.80, RandomStream(1, "planner"));
  PlanningMap map({}, Footprint(robot.footprint), config.poses.padding, planner.reach(0.05));
  map.set_map(house);
  map.update(Time{});
  constexpr std::uint64_t kTasks = 20;
  std::uint64_t number = 0;
  std::size_t states = 0;
  for (auto _ : state) {
    state.PauseTiming();
    RandomStream random(number++ % kTasks, "path_planner_bench");
    const test::EggTask task = tasks.draw(random);
    const Pose2 goal = *tasks.goal_for(task.start, task.egg);
    state.ResumeTiming();
    const auto plan = planner.plan(map.costmap(), task.start, goal, 0);
    if (plan) states += plan->states;
  }
  state.counters["states"] =
      benchmark::Counter(static_cast<double>(states), benchmark::Counter::kAvgIterations);
}
BENCHMARK(BM_DrivablePlan)->Unit(benchmark::kMillisecond)->Iterations(20);

/// The costmap of the house from its layers, after a change of the map.
void BM_PlanningMapUpdate(benchmark::State& state) {
  const OccupancyGrid house = test::make_duck_house();
  const test::ExperimentRobot robot;
  PlanningMap map({}, Footprint(robot.footprint), 0.06, 0.8);
  for (auto _ : state) {
    map.set_map(house);
    benchmark::DoNotOptimize(map.update(Time{}));
  }
}
BENCHMARK(BM_PlanningMapUpdate)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::global_planner
