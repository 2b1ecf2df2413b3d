#include <benchmark/benchmark.h>

#include "unit/arm_driver/arms.hpp"

namespace coop::arm_driver {
namespace {

const Eigen::Vector3d kDown(0, 0, -1);

void forward_kinematics(benchmark::State& state) {
  const ArmMotion motion(test::collector(), {});
  for (auto _ : state) benchmark::DoNotOptimize(motion.chain().tip_in_reference(motion.home()));
}
BENCHMARK(forward_kinematics);

void inverse_kinematics_of_an_egg(benchmark::State& state) {
  const ArmMotion motion(test::collector(), {});
  const InverseKinematics ik(motion.chain());
  for (auto _ : state) {
    benchmark::DoNotOptimize(ik.solve({Eigen::Vector3d(0.95, 0.1, 0.045), kDown}, motion.home()));
  }
}
BENCHMARK(inverse_kinematics_of_an_egg);

/// All starts are tried, with limits and without: the dearest answer.
void inverse_kinematics_out_of_reach(benchmark::State& state) {
  const ArmMotion motion(test::collector(), {});
  const InverseKinematics ik(motion.chain());
  for (auto _ : state) {
    benchmark::DoNotOptimize(ik.solve({Eigen::Vector3d(2.0, 0.0, 0.045), kDown}, motion.home()));
  }
}
BENCHMARK(inverse_kinematics_out_of_reach);

void touches_of_an_egg(benchmark::State& state) {
  const ArmMotion motion(test::collector(), {});
  for (auto _ : state) benchmark::DoNotOptimize(motion.touches({0.92, 0.0}));
}
BENCHMARK(touches_of_an_egg);

}  // namespace
}  // namespace coop::arm_driver
