// How fast a whole mission runs in lockstep: eight programs and the referee over DDS find and
// collect five eggs, as in the navigation experiment.
//   mission_bench --benchmark_out=FILE --benchmark_out_format=json
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "system/support/running_system.hpp"

namespace {

using coop::test::RunningSystem;

constexpr std::chrono::minutes kLimit{15};

/// Seconds of processor time of all programs that have ended so far.
double processor_time() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Span {
  double simulated = 0.0;  ///< s
  double wall = 0.0;  ///< s, from the first tick to the last, without the start of the programs
};

/// The simulator's log tells when the first members ran their first tick, and when it was left
/// alone.
std::optional<Span> span_of(const std::filesystem::path& log_file) {
  std::ifstream log(log_file);
  std::optional<nlohmann::json> first;
  std::optional<nlohmann::json> last;
  for (std::string line; std::getline(log, line);) {
    auto entry = nlohmann::json::parse(line, nullptr, false);
    if (entry.is_discarded()) continue;
    if (!entry.value("text", "").starts_with("lockstep: ")) continue;
    if (!first) first = entry;
    last = std::move(entry);
  }
  if (!first) return std::nullopt;
  const auto between = [&](const char* key) {
    return last->value(key, 0.0) - first->value(key, 0.0);
  };
  return Span{.simulated = between("stamp"), .wall = between("wall")};
}

/// Argument: seed.
void mission(benchmark::State& state) {
  const auto launch = std::filesystem::path(COOP_SOURCE_DIR) / "config/launch/experiment.yaml";
  const std::string seed = "seed=" + std::to_string(state.range(0));
  Span sum;
  const double processor_before = processor_time();
  for ([[maybe_unused]] auto _ : state) {
    RunningSystem system(launch, {"--set", seed, "--until", "mission-done"});
    const auto status = system.launcher().wait(kLimit);
    const auto span = span_of(system.folder() / "runs/latest/logs/simulator.jsonl");
    if (!status || !status->clean() || !span) {
      state.SkipWithError("the mission did not end well");
      break;
    }
    sum.simulated += span->simulated;
    sum.wall += span->wall;
  }
  state.counters["simulated_s"] =
      benchmark::Counter(sum.simulated, benchmark::Counter::kAvgIterations);
  state.counters["times_real_time"] = sum.simulated / sum.wall;
  state.counters["processors_busy"] = (processor_time() - processor_before) / sum.wall;
}
BENCHMARK(mission)
    ->ArgName("seed")
    ->Arg(1)
    ->Arg(3)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
