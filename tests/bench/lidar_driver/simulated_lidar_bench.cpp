#include <benchmark/benchmark.h>

#include "experiments/worlds/duck_house.hpp"
#include "lidar_driver/simulated_lidar.hpp"

namespace {

using namespace coop;

/// One scan of 360 beams in the duck house, from places along its length. At 10 Hz, 5 ms a scan
/// would be 5 % of a core.
void scan(benchmark::State& state) {
  world::World world;
  world.grid = worlds::duck_house();
  const lidar_driver::SimulatedLidar lidar({}, world, {0.62, 0.0, 0.0}, 1);
  world::GroundTruth truth;
  for (int i = 0; i < state.range(0); ++i) {
    truth.animals.push_back({"", {3.0 + i % 10, 6.0 + 0.5 * (i / 10)}, {0, 0}, 0.14});
  }
  LaserScan out;
  std::int64_t number = 0;
  for (auto _ : state) {
    ++number;
    truth.stamp = Time(std::chrono::milliseconds(100 * number));
    truth.robot_in_world = {2.0 + 0.01 * static_cast<double>(number % 1000), 3.0, 0.0};
    lidar.measure(truth, out);
    benchmark::DoNotOptimize(out.ranges.data());
  }
  state.SetItemsProcessed(state.iterations() * 360);
}
BENCHMARK(scan)->Arg(0)->Arg(20);

}  // namespace
