// One frame: what it costs to draw, and to look for eggs in. At 5 Hz, 20 % of a core are 40 ms.
#include <benchmark/benchmark.h>

#include "unit/camera_driver/duck_house.hpp"

namespace coop::camera_driver {
namespace {

SimulatedCameraConfig size_of(const benchmark::State& state) {
  SimulatedCameraConfig config;
  config.width = static_cast<int>(state.range(0));
  config.height = static_cast<int>(state.range(1));
  return config;
}

void TakeFrame(benchmark::State& state) {
  const world::World world = test::duck_house();
  SimulatedCamera camera(size_of(state), world, test::camera_in_base(), 1);
  RandomStream random(1, "scenes");
  std::vector<world::GroundTruth> scenes;
  for (int i = 0; i < 32; ++i) scenes.push_back(test::random_scene(world, random));
  Frame frame;
  std::size_t i = 0;
  for (auto _ : state) {
    camera.take(scenes[i++ % scenes.size()], frame);
    benchmark::DoNotOptimize(frame.depth.data);
  }
}

void DetectEggs(benchmark::State& state) {
  const world::World world = test::duck_house();
  const Pose3 mount = test::camera_in_base();
  SimulatedCamera camera(size_of(state), world, mount, 1);
  EggDetector detector({}, camera.intrinsics(), mount);
  RandomStream random(1, "scenes");
  Frame frame;
  camera.take(test::random_scene(world, random), frame);
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(frame));
}

BENCHMARK(TakeFrame)->Args({424, 240})->Args({640, 480})->Unit(benchmark::kMillisecond);
BENCHMARK(DetectEggs)->Args({424, 240})->Args({640, 480})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::camera_driver
