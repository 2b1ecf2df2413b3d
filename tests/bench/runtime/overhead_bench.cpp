// What Coop's runtime costs over Fast DDS itself, and what security costs over none: a message
// every millisecond from one process to another. The ways take turns message by message, so that
// the machine is the same for all.
//   overhead_bench --benchmark_out=FILE --benchmark_out_format=json
#include <benchmark/benchmark.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <mutex>

#include "bench/runtime/raw_dds.hpp"
#include "geometry_msgs/msg/TwistStamped.h"
#include "launcher/keys/key_folder.hpp"
#include "runtime/dds_transport.hpp"
#include "runtime/node.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace coop;
using namespace coop::runtime;
using Message = geometry_msgs::msg::TwistStamped;
using Wall = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr int kDomain = 58;
constexpr auto kPeriod = milliseconds(1);
constexpr std::size_t kSamples = 2000;
constexpr std::size_t kMillion = 1'000'000;
constexpr auto kPatience = std::chrono::seconds(60);
// Permissions go by the system's topics and programs.
const std::string kTalker = "dwa";
const std::string kHearer = "simulator";
const std::string kTopic = "cmd_vel";
const std::string kEvents = "tf";

DdsOptions options_of(const std::string& name, const std::string& keys) {
  DdsOptions options;
  options.domain = kDomain;
  options.participant_name = name;
  options.settings.security = !keys.empty();
  options.settings.keys = keys;
  return options;
}

void stamp(Message& message) {
  const auto now = Wall::now().time_since_epoch();
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(now);
  message.header().stamp().sec(static_cast<std::int32_t>(whole.count()));
  message.header().stamp().nanosec(static_cast<std::uint32_t>((now - whole).count()));
}

/// Microseconds since it was stamped; the steady clock is the same for all processes.
double age(const Message& message) {
  const auto& time = message.header().stamp();
  const auto sent = std::chrono::seconds(time.sec()) + std::chrono::nanoseconds(time.nanosec());
  return std::chrono::duration<double, std::micro>(Wall::now().time_since_epoch() - sent).count();
}

/// A program of Coop: participant, executor, node.
struct Program {
  Program(const std::string& name, const std::string& keys)
      : transport(options_of(name, keys)),
        executor(clock),
        node(named(name), transport, clock, executor) {}
  static Options named(const std::string& name) {
    Options options;
    options.name = name;
    return options;
  }
  SystemClock clock;
  DdsTransport transport;
  Executor executor;
  Node node;
};

/// The other process: takes turns among the ways until it is killed.
int talk(const std::string& keys, bool with_raw) {
  Program program(kTalker, keys);
  auto publisher = program.node.advertise<Message>(kTopic, Qos::kCommand);
  const auto& type = message_type<Message>();
  std::optional<bench::RawParticipant> raw;
  std::vector<eprosima::fastdds::dds::DataWriter*> writers;
  if (with_raw) {
    raw.emplace(options_of("raw_talker", ""), type);
    for (const char* topic : {"raw_listener", "raw_waiter"}) {
      writers.push_back(raw->writer(topic, type, Qos::kCommand));
    }
  }
  Message message;
  message.header().frame_id("base_link");
  auto next = Wall::now();
  const auto pause = [&] {
    next += kPeriod;
    std::this_thread::sleep_until(next);
  };
  for (;;) {
    stamp(message);
    publisher.publish(message);
    pause();
    for (auto* writer : writers) {
      stamp(message);
      writer->write(&message);
      pause();
    }
    program.executor.run_once();
  }
}

/// The other process: a million messages, each as soon as the one before is handed over.
int pour() {
  Program program(kTalker, "");
  auto publisher = program.node.advertise<Message>(kEvents, Qos::kEvent);
  while (publisher.subscribers() == 0) std::this_thread::sleep_for(kPeriod);
  Message message;
  for (std::size_t i = 0; i < kMillion; ++i) {
    message.twist().linear().x(static_cast<double>(i));
    while (!publisher.publish(message)) {
    }
  }
  return publisher.wait_for_acknowledgments(kPatience) ? 0 : 1;
}

class OtherProcess {
 public:
  OtherProcess(const std::string& role, const std::string& keys) {
    std::string program = "/proc/self/exe";
    std::string first = role;
    std::string second = keys.empty() ? "-" : keys;
    char* arguments[] = {program.data(), first.data(), second.data(), nullptr};
    if (::posix_spawn(&pid_, program.c_str(), nullptr, nullptr, arguments, environ) != 0) pid_ = 0;
  }
  ~OtherProcess() { (void)end(); }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;
  /// Processor time it took, in seconds.
  double end() {
    if (pid_ == 0) return 0.0;
    rusage used{};
    ::kill(pid_, SIGKILL);
    ::wait4(pid_, nullptr, 0, &used);
    pid_ = 0;
    return seconds_of(used);
  }
  static double seconds_of(const rusage& used) {
    const auto add = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return add(used.ru_utime) + add(used.ru_stime);
  }

 private:
  pid_t pid_ = 0;
};

double own_processor_time() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return OtherProcess::seconds_of(used);
}

/// Latencies of one way, written by one thread and read when it has ended.
class Latencies {
 public:
  void add(double value) {
    const std::scoped_lock lock(mutex_);
    values_.push_back(value);
  }
  [[nodiscard]] std::size_t size() const {
    const std::scoped_lock lock(mutex_);
    return values_.size();
  }
  /// After the first tenth: threads, caches and matching have settled.
  [[nodiscard]] double quantile(double share) const {
    std::vector<double> settled(values_.begin() + static_cast<long>(values_.size() / 10),
                                values_.end());
    if (settled.empty()) return 0.0;
    std::ranges::sort(settled);
    return settled[static_cast<std::size_t>(share * static_cast<double>(settled.size() - 1))];
  }

 private:
  mutable std::mutex mutex_;
  std::vector<double> values_;
};

/// Until all ways have their samples; false when that takes too long.
bool collect(Program& program, const std::vector<const Latencies*>& ways) {
  const auto limit = Wall::now() + kPatience;
  while (Wall::now() < limit) {
    program.executor.wait_and_run(milliseconds(100));
    if (std::ranges::all_of(ways, [](const auto* way) { return way->size() >= kSamples; }))
      return true;
  }
  return false;
}

/// Coop's runtime beside raw Fast DDS with a listener (no thread of one's own, nothing kept apart)
/// and with a thread that waits, as a program must that handles several inputs one at a time.
void runtime_and_raw(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    Latencies coop, listener, waiter;
    Program program(kHearer, "");
    program.node.subscribe<Message>(kTopic, Qos::kCommand,
                                    [&](const Message& message) { coop.add(age(message)); });
    const auto& type = message_type<Message>();
    bench::RawListener<Message> raw_listener(
        [&](const Message& message) { listener.add(age(message)); });
    bench::RawParticipant raw(options_of("raw_hearer", ""), type);
    (void)raw.reader("raw_listener", type, Qos::kCommand, &raw_listener);
    const bench::RawWaiter<Message> raw_waiter(
        raw.reader("raw_waiter", type, Qos::kCommand, nullptr),
        [&](const Message& message) { waiter.add(age(message)); });
    OtherProcess talker("--talk-both", "");
    if (!collect(program, {&coop, &listener, &waiter})) state.SkipWithError("nothing arrives");
    talker.end();
    // The lowest tenth is what the ways themselves take; above it the machine's other work shows.
    for (const auto& [name, share] : {std::pair("p10", 0.1), std::pair("p50", 0.5)}) {
      const std::string suffix = std::string("_") + name;
      state.counters["coop_us" + suffix] = coop.quantile(share);
      state.counters["raw_waiting_us" + suffix] = waiter.quantile(share);
      state.counters["raw_listening_us" + suffix] = listener.quantile(share);
      state.counters["to_waiting" + suffix] = coop.quantile(share) / waiter.quantile(share);
      state.counters["to_listening" + suffix] = coop.quantile(share) / listener.quantile(share);
    }
  }
}
BENCHMARK(runtime_and_raw)->Iterations(1)->Repetitions(5)->Unit(benchmark::kSecond)->UseRealTime();

void one_million_messages(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    std::size_t heard = 0;
    std::size_t out_of_order = 0;
    Program program(kHearer, "");
    program.node.subscribe<Message>(kEvents, Qos::kEvent, [&](const Message& message) {
      if (message.twist().linear().x() != static_cast<double>(heard)) ++out_of_order;
      ++heard;
    });
    const OtherProcess source("--pour", "");
    auto limit = Wall::now() + kPatience;
    for (std::size_t before = 0; heard < kMillion && Wall::now() < limit;) {
      program.executor.wait_and_run(milliseconds(100));
      if (heard > before) limit = Wall::now() + kPatience;
      before = heard;
    }
    state.counters["heard"] = static_cast<double>(heard);
    state.counters["out_of_order"] = static_cast<double>(out_of_order);
    if (heard != kMillion || out_of_order > 0) state.SkipWithError("messages were lost");
  }
}
BENCHMARK(one_million_messages)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

/// Argument: 0 open, 1 discovery protected, 2 data encrypted, 3 everything encrypted.
void security(benchmark::State& state) {
  const test::TemporaryFolder folder;
  std::string where;
  if (state.range(0) > 0) {
    const auto now = std::chrono::system_clock::now();
    const auto hour = std::chrono::hours(1);
    const keys::System system{.domain = kDomain, .robot = ""};
    const keys::KeyFolder made(folder.path() / "keys", now - hour);
    made.write_governance(system, static_cast<keys::Protection>(state.range(0) - 1));
    for (const std::string& name : {kTalker, kHearer}) {
      made.issue(system, {.name = name, .program = name}, now - hour, now + hour);
    }
    where = (folder.path() / "keys").string();
  }
  for ([[maybe_unused]] auto _ : state) {
    Latencies coop;
    Program program(kHearer, where);
    program.node.subscribe<Message>(kTopic, Qos::kCommand,
                                    [&](const Message& message) { coop.add(age(message)); });
    const double before = own_processor_time();
    OtherProcess talker("--talk", where);
    if (!collect(program, {&coop})) state.SkipWithError("nothing arrives");
    const double used = own_processor_time() - before + talker.end();
    state.counters["latency_us"] = coop.quantile(0.5);
    state.counters["latency_us_p10"] = coop.quantile(0.1);
    state.counters["cpu_us_a_message"] = 1e6 * used / static_cast<double>(coop.size());
  }
}
BENCHMARK(security)
    ->DenseRange(0, 3)
    ->Iterations(1)
    ->Repetitions(3)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3) {
    const std::string role = argv[1];
    const std::string keys = std::string(argv[2]) == "-" ? "" : argv[2];
    if (role == "--pour") return pour();
    if (role.starts_with("--talk")) return talk(keys, role == "--talk-both");
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
