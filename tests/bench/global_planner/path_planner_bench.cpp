#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>

#include "experiments/navigation/duck_house.hpp"
#include "global_planner/path_planner.hpp"
#include "global_planner/planning_map.hpp"
#include "support/warehouse.hpp"

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

/// What a scan costs in the warehouse: 360 beams, of which twenty see a box that comes and goes.
void BM_PlanningMapUpdateByAScan(benchmark::State& state) {
  const Costmap* warehouse = test::warehouse();
  if (warehouse == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  OccupancyGrid floor(warehouse->geometry(), kFree);
  for (std::size_t i = 0; i < floor.cells.size(); ++i) {
    if (warehouse->obstacles()[i] != 0) floor.cells[i] = kOccupied;
  }
  Cell place{floor.geometry.width / 2, floor.geometry.height / 2};
  while (warehouse->cost_at(place) != kFreeCost) ++place.y;
  const Eigen::Vector2d at = floor.geometry.center_of(place);
  const Pose2 robot{at.x(), at.y(), 0.0};
  const test::ExperimentRobot body;
  PlanningMap map({.obstacles = {.hold_time = 0.0}}, Footprint(body.footprint), 0.06, 0.8);
  map.set_map(floor);
  LaserScan scan;
  scan.angle_increment = static_cast<float>(2.0 * std::numbers::pi / 360.0);
  scan.range_min = 0.1F;
  scan.range_max = 8.0F;
  int count = 0;
  const auto update = [&] {
    scan.stamp = time_from_seconds(1000.0 + 0.1 * ++count);
    scan.ranges.assign(360, 2.5F);
    if (count % 2 == 0) std::fill_n(scan.ranges.begin() + 40, 20, 1.5F);
    map.integrate(scan, {robot, robot, {}});
    benchmark::DoNotOptimize(map.update(scan.stamp, robot));
  };
  update();
  update();
  for (auto _ : state) update();
}
BENCHMARK(BM_PlanningMapUpdateByAScan)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace coop::global_planner
