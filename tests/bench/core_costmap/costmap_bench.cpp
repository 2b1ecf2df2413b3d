#include <benchmark/benchmark.h>

#include <algorithm>

#include "support/warehouse.hpp"

namespace coop {
namespace {

void BM_CostmapFromScratch(benchmark::State& state) {
  const Costmap* source = test::warehouse();
  if (source == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  Costmap costmap({}, 0.28);
  for (auto _ : state) {
    costmap.reset(source->geometry());
    std::copy(source->obstacles().begin(), source->obstacles().end(), costmap.obstacles().begin());
    costmap.update();
    benchmark::DoNotOptimize(costmap.costs().cells.data());
  }
}
BENCHMARK(BM_CostmapFromScratch)->Unit(benchmark::kMillisecond);

void BM_DistanceTransform(benchmark::State& state) {
  const Costmap* source = test::warehouse();
  if (source == nullptr) {
    state.SkipWithError("not run: shared map is absent");
    return;
  }
  DistanceTransform transform;
  std::vector<std::int32_t> squared(source->geometry().size());
  for (auto _ : state) {
    transform.run(source->obstacles(), source->geometry().width, source->geometry().height, squared,
                  static_cast<int>(state.range(0)));
    benchmark::DoNotOptimize(squared.data());
  }
}
BENCHMARK(BM_DistanceTransform)
    ->Arg(21)
    ->Arg(DistanceTransform::kNoCap)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop
