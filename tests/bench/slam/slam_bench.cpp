// What one scan costs: the match, the drawing, and a whole step of the filter.
#include <benchmark/benchmark.h>

#include "slam/map_updater.hpp"
#include "slam/particle_filter.hpp"
#include "slam/scan_matcher.hpp"
#include "support/simulated_room.hpp"

namespace coop::slam {
namespace {

const Pose2 kTruth{3.0, 1.5, 0.4};
const Pose2 kPredicted = kTruth * Pose2{0.03, -0.02, 0.02};

struct Scene {
  Scene() : drive(test::barn(), kTruth, 7) {
    points = to_points(drive.scan(), drive.laser_in_base, {}, {});
    MapUpdater().integrate(map, points, kTruth);
  }
  test::SimulatedDrive drive;
  TileMap map{0.05};
  ScanPoints points;
};

void match_scan(benchmark::State& state) {
  Scene scene;
  ScanMatcher matcher({});
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        matcher.match(scene.map, scene.points, kPredicted, {0.05, 0.05, 0.05}));
  }
}
BENCHMARK(match_scan)->Unit(benchmark::kMicrosecond);

void search_wide(benchmark::State& state) {
  Scene scene;
  ScanMatcherConfig config;
  config.poor_match = 0.0;  // always
  ScanMatcher matcher(config);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        matcher.match(scene.map, scene.points, kPredicted, {0.05, 0.05, 0.05}));
  }
}
BENCHMARK(search_wide)->Unit(benchmark::kMicrosecond);

void draw_scan(benchmark::State& state) {
  Scene scene;
  MapUpdater updater;
  for (auto _ : state) updater.integrate(scene.map, scene.points, kTruth);
}
BENCHMARK(draw_scan)->Unit(benchmark::kMicrosecond);

/// A second of the survey at 0.5 m/s: ten scans, of which the filter uses those after enough
/// motion.
void second_of_survey(benchmark::State& state) {
  SlamConfig config;
  config.particles = static_cast<int>(state.range(0));
  ForkJoin workers(1);
  ParticleFilter filter(config, 1, workers);
  test::SimulatedDrive drive(test::barn(), {2.0, 1.5, 0.0}, 5);
  for (auto _ : state) {
    for (int i = 0; i < 10; ++i) {
      state.PauseTiming();
      drive.follow_tour();
      const LaserScan scan = drive.scan();
      state.ResumeTiming();
      filter.update(scan, drive.base_in_odom, drive.laser_in_base);
    }
  }
}
BENCHMARK(second_of_survey)->Arg(15)->Arg(30)->Unit(benchmark::kMillisecond)->Iterations(30);

}  // namespace
}  // namespace coop::slam
