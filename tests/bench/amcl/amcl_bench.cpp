// What one scan costs. At 10 Hz, 10 % of a core are 10 ms.
#include <benchmark/benchmark.h>

#include "amcl/amcl.hpp"
#include "support/simulated_room.hpp"

namespace coop::amcl {
namespace {

/// A whole update, weighed in, with a fixed number of particles.
void Update(benchmark::State& state) {
  AmclConfig config;
  config.update_distance = 0.0;
  config.kld.min_particles = static_cast<int>(state.range(0));
  config.kld.max_particles = static_cast<int>(state.range(0));
  Amcl amcl(config, test::mapped(test::barn()), 1);
  PoseEstimate start{{2, 1.5, 0}, Eigen::Matrix3d::Identity() * 0.01};
  amcl.set_pose(start);
  test::SimulatedDrive drive(test::barn(), start.pose, 1);
  for (auto _ : state) {
    state.PauseTiming();
    drive.follow_tour();
    const LaserScan scan = drive.scan();
    state.ResumeTiming();
    benchmark::DoNotOptimize(amcl.update(scan, drive.laser_in_base, drive.base_in_odom));
  }
  state.counters["particles"] = static_cast<double>(amcl.particles().size());
}

/// The first scan after particles were scattered over the whole map.
void FirstScanOfGlobalLocalisation(benchmark::State& state) {
  Amcl amcl({}, test::mapped(test::barn()), 1);
  test::SimulatedDrive drive(test::barn(), {2, 1.5, 0}, 1);
  for (auto _ : state) {
    state.PauseTiming();
    (void)amcl.scatter();
    drive.follow_tour();
    const LaserScan scan = drive.scan();
    state.ResumeTiming();
    benchmark::DoNotOptimize(amcl.update(scan, drive.laser_in_base, drive.base_in_odom));
  }
}

void BuildLikelihoodField(benchmark::State& state) {
  const OccupancyGrid map = test::mapped(test::barn());
  for (auto _ : state) benchmark::DoNotOptimize(LikelihoodField({}, map));
}

BENCHMARK(Update)->Arg(500)->Arg(3000)->Arg(20000)->Iterations(300)->Unit(benchmark::kMillisecond);
BENCHMARK(FirstScanOfGlobalLocalisation)->Iterations(10)->Unit(benchmark::kMillisecond);
BENCHMARK(BuildLikelihoodField)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::amcl
