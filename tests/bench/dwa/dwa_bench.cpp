#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>

#include "core/world/ray_caster.hpp"
#include "dwa/dwa.hpp"
#include "experiments/navigation/duck_house.hpp"

namespace coop::dwa {
namespace {

/// A robot under way in the duck house between feeder and nest boxes.
struct Scene {
  OccupancyGrid house = test::make_duck_house();
  test::ExperimentRobot robot;
  vehicle::AckermannGeometry base = [this] {
    vehicle::AckermannGeometry geometry;
    geometry.wheelbase = robot.wheelbase;
    geometry.track = robot.track;
    geometry.max_steering_angle = robot.max_steering;
    return geometry;
  }();
  Pose2 pose{3.0, 7.4, 0.0};
  Time now = time_from_seconds(100.0);

  [[nodiscard]] LaserScan scan() const {
    const world::RayCaster rays(house);
    LaserScan scan;
    scan.stamp = now;
    scan.angle_min = -std::numbers::pi_v<float>;
    scan.angle_increment = std::numbers::pi_v<float> / 180.0F;
    scan.range_min = 0.1F;
    scan.range_max = 8.0F;
    for (std::size_t i = 0; i < 360; ++i) {
      const double angle = scan.angle(i);
      const auto hit =
          rays.cast({pose.x + robot.laser_x, pose.y}, {std::cos(angle), std::sin(angle)}, 8.0);
      scan.ranges.push_back(hit ? static_cast<float>(hit->range) : 9.0F);
    }
    return scan;
  }
};

/// One control step at 20 Hz: local costmap, window, prediction, collision checks, scores.
void BM_ControlStep(benchmark::State& state) {
  Scene scene;
  Dwa dwa({}, scene.robot.footprint, scene.base, 0.8);
  dwa.local_map().set_static_map(scene.house);
  dwa.local_map().integrate(scene.scan(), {scene.pose, scene.pose, {scene.robot.laser_x, 0, 0}});
  std::vector<Pose2> plan;
  for (int i = 0; i <= 120; ++i) plan.push_back({scene.pose.x + 0.05 * i, scene.pose.y, 0.0});
  dwa.set_plan("1", plan);
  DwaInputs inputs;
  inputs.odometry = Odometry{scene.now, scene.pose, {0.4, 0.0}};
  inputs.odom_in_map = StampedPose2{scene.now, {}};
  inputs.scan_stamp = scene.now;
  for (auto _ : state) {
    const DwaOutput output = dwa.update(inputs, scene.now);
    if (output.state != DriveState::kDriving) {
      state.SkipWithError("does not drive");
      break;
    }
  }
}
BENCHMARK(BM_ControlStep)->Unit(benchmark::kMillisecond);

void BM_IntegrateScan(benchmark::State& state) {
  Scene scene;
  Dwa dwa({}, scene.robot.footprint, scene.base, 0.8);
  LaserScan scan = scene.scan();
  for (auto _ : state) {
    scan.stamp += std::chrono::milliseconds(100);
    dwa.local_map().integrate(scan, {scene.pose, scene.pose, {scene.robot.laser_x, 0, 0}});
  }
}
BENCHMARK(BM_IntegrateScan)->Unit(benchmark::kMillisecond);

/// 0: nothing new (every second control step); 1: a scan, in which a box comes and goes; 2: the
/// robot's place in the map was put right.
void BM_LocalMapUpdate(benchmark::State& state) {
  Scene scene;
  LocalMap map({.obstacles = {.hold_time = 0.0}}, Footprint(scene.robot.footprint), 1.5);
  map.set_static_map(scene.house);
  LaserScan scan = scene.scan();
  const std::vector<float> ranges = scan.ranges;
  Pose2 odom_in_map;
  int count = 0;
  const auto integrate = [&] {
    scan.stamp += std::chrono::milliseconds(100);
    scan.ranges = ranges;
    if (++count % 2 == 0) std::fill_n(scan.ranges.begin() + 40, 10, 0.6F);
    map.integrate(scan, {scene.pose, scene.pose, {scene.robot.laser_x, 0, 0}});
  };
  integrate();
  map.update(scene.pose, odom_in_map, scan.stamp);
  for (auto _ : state) {
    if (state.range(0) == 1) integrate();
    if (state.range(0) == 2) odom_in_map.x = ++count % 2 == 0 ? 0.01 : 0.0;
    map.update(scene.pose, odom_in_map, scan.stamp);
    benchmark::DoNotOptimize(map.costmap().costs().cells.data());
  }
}
BENCHMARK(BM_LocalMapUpdate)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace coop::dwa
