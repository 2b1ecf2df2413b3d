// What lockstep itself costs: ten processes over DDS that have nothing to do but their ticks.
//   lockstep_bench --benchmark_out=FILE --benchmark_out_format=json
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "runtime/dds_transport.hpp"
#include "runtime/lockstep/follower.hpp"
#include "runtime/lockstep/master.hpp"
#include "runtime/node.hpp"
#include "runtime/stop_signal.hpp"
#include "std_msgs/msg/String.h"

namespace {

using namespace coop;
using namespace coop::runtime;
using Text = std_msgs::msg::String;

constexpr int kDomain = 231;
constexpr auto kTick = std::chrono::milliseconds(10);
const std::string kFollower = "--follower";

struct Carrier {
  explicit Carrier(const std::string& name)
      : dds({.domain = kDomain, .participant_name = name, .partition = {}, .complete = true}),
        transport(dds, name, nullptr),
        executor(clock) {
    options.name = name;
    options.lockstep = true;
  }
  Options options;
  DdsTransport dds;
  LockstepTransport transport;
  ManualClock clock;
  Executor executor;
};

/// A component that does nothing, every tick. With `reads`, it hears one sample a tick as well.
int follow(const std::string& name, bool reads) {
  Carrier carrier(name);
  const StopSignal stop(carrier.executor);
  LockstepFollower follower(carrier.executor, carrier.dds, carrier.transport, name);
  Node node(carrier.options, carrier.transport, carrier.clock, carrier.executor);
  std::uint64_t heard = 0;
  if (reads) {
    node.subscribe<Text>("reading", Qos::kSensorStream, [&heard](const Text&) { ++heard; });
  }
  node.every(kTick, [] {});
  follower.join(node.log(), [&](Time time) {
    const bool is_first = carrier.clock.now() == Time{};
    carrier.clock.set(time);
    if (is_first) node.handle_clock_jump();
  });
  while (!StopSignal::requested()) carrier.executor.wait_and_run(std::chrono::milliseconds(500));
  return 0;
}

class Followers {
 public:
  Followers(int count, bool reads) {
    for (int i = 0; i < count; ++i) {
      std::string name = "member" + std::to_string(i);
      names.push_back(name);
      std::string program = "/proc/self/exe";
      std::string role = kFollower;
      std::string how = reads ? "reads" : "idle";
      char* arguments[] = {program.data(), role.data(), name.data(), how.data(), nullptr};
      pid_t pid = 0;
      if (::posix_spawn(&pid, program.c_str(), nullptr, nullptr, arguments, environ) == 0) {
        pids_.push_back(pid);
      }
    }
  }
  ~Followers() {
    for (const pid_t pid : pids_) ::kill(pid, SIGKILL);
    for (const pid_t pid : pids_) ::waitpid(pid, nullptr, 0);
  }
  Followers(const Followers&) = delete;
  Followers& operator=(const Followers&) = delete;
  std::vector<std::string> names;

 private:
  std::vector<pid_t> pids_;
};

/// Arguments: members besides the master; whether the master writes a sample a tick that all read.
void tick(benchmark::State& state) {
  const bool reads = state.range(1) != 0;
  const Followers followers(static_cast<int>(state.range(0)), reads);
  Carrier carrier("world");
  LockstepMaster master(carrier.executor, carrier.dds, carrier.transport, "world", followers.names);
  Node node(carrier.options, carrier.transport, carrier.clock, carrier.executor);
  auto readings = node.advertise<Text>("reading", Qos::kSensorStream);
  std::int64_t steps = 0;
  node.lead_time({.period = kTick, .rate = 0.0, .step = [&] {
                    if (reads) readings.publish(Text());
                    return Time(std::chrono::seconds(1) + ++steps * kTick);
                  }});
  master.start(node, *node.time_lead());
  const auto run_to = [&](std::int64_t step) {
    const auto patience = Executor::Wall::now() + std::chrono::seconds(30);
    while (steps < step && Executor::Wall::now() < patience) {
      carrier.executor.wait_and_run(std::chrono::milliseconds(100));
    }
    return steps >= step;
  };
  if (!run_to(100)) state.SkipWithError("the members did not join");
  for ([[maybe_unused]] auto _ : state) {
    if (!run_to(steps + 1)) {
      state.SkipWithError("a tick did not end");
      break;
    }
  }
}
BENCHMARK(tick)
    ->ArgNames({"members", "reads"})
    ->Args({1, 0})
    ->Args({9, 0})
    ->Args({9, 1})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime()
    ->MinTime(2.0);

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && argv[1] == kFollower) return follow(argv[2], std::string(argv[3]) == "reads");
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
