#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>

#include "core/state_journal.hpp"
#include "experiments/worlds/duck_house.hpp"
#include "simulator/simulation.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace coop;

simulator::Simulation duck_house_simulation(int animals) {
  world::World world;
  world.grid = worlds::duck_house();
  world.robot_start = {2.0, 2.8, 0.0};
  world.seed = 1;
  for (int i = 0; i < 5; ++i) {
    world.eggs.push_back({"egg_" + std::to_string(i + 1), {3.0 + i, 3.2, 0.0225}});
  }
  std::vector<simulator::AnimalDescription> flock;
  for (int i = 0; i < animals; ++i) {
    flock.push_back({.id = "", .x = 3.0 + i % 10, .y = 6.0 + 0.5 * (i / 10)});
  }
  const auto urdf = std::filesystem::path(COOP_SOURCE_DIR) / "config/robot/egg_collector.urdf";
  return {{}, simulator::shape_of(robot::RobotModel::load(urdf)), world, flock};
}

/// One tick of 10 ms with the robot driving circles.
void tick(benchmark::State& state) {
  auto simulation = duck_house_simulation(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    simulation.gate().accept({0.4, 0.45}, simulation.now());
    simulation.step();
    benchmark::DoNotOptimize(simulation.ground_truth());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(tick)->Arg(0)->Arg(20);

/// Storing the state and writing it to the journal, as every tick does.
void journal(benchmark::State& state) {
  const test::TemporaryFolder folder;
  auto simulation = duck_house_simulation(static_cast<int>(state.range(0)));
  std::string record;
  simulation.store(record);
  StateJournal file(folder.path() / "simulator.journal", record.size());
  for (auto _ : state) {
    record.clear();
    simulation.store(record);
    file.write(record);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(record.size()));
}
BENCHMARK(journal)->Arg(0)->Arg(20);

}  // namespace
