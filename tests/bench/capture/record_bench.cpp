// How much the recorder takes in over DDS on one machine, writer and recorder a process each, with
// nothing lost: small messages as fast as the recorder follows (the writer is reliable and keeps
// everything), and images at a rate. `recorder_cpu`, `writer_cpu`: processor time of each, as a
// part of one processor, starting and ending included for the recorder.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "capture/mcap/reader.hpp"
#include "runtime/dds_transport.hpp"
#include "sensor_msgs/msg/Image.h"
#include "std_msgs/msg/String.h"
#include "support/temporary_folder.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::capture {
namespace {

double processor_seconds(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The program, at work.
class Recorder {
 public:
  explicit Recorder(const std::filesystem::path& folder)
      : program_("record",
                 {"--domain", std::to_string(test::test_domain()), "--topics", "/bench",
                  "--compression", "lz4", "-o", (folder / "captures").string()},
                 folder / "record.out") {}
  /// What it said.
  std::string finish() {
    program_.signal(SIGINT);
    if (!program_.wait(std::chrono::minutes(1))) {
      throw std::runtime_error("the recorder does not end");
    }
    return program_.output();
  }

 private:
  test::Program program_;
};

std::uint64_t messages_in(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    return mcap::Reader(entry.path()).summary().statistics->message_count;
  }
  return 0;
}

/// What is written: by each of so many writers, `period` between two messages (0: none).
struct Load {
  int writers = 1;
  std::uint64_t messages = 0;
  std::chrono::nanoseconds period{};
};

/// A participant with a writer.
class Talker {
 public:
  explicit Talker(const runtime::MessageType& type)
      : transport_({.domain = test::test_domain(), .participant_name = "talker", .partition = {}}),
        writer_(transport_.create_writer("bench", type, runtime::Qos::kEvent)) {}
  void wait_for_reader() const {
    while (writer_->matched_readers() == 0) std::this_thread::yield();
  }
  void talk(const void* message, const Load& load) {
    auto due = std::chrono::steady_clock::now();
    for (std::uint64_t i = 0; i < load.messages; ++i) {
      std::this_thread::sleep_until(due += load.period);
      while (!writer_->write(message)) std::this_thread::yield();
    }
    writer_->wait_for_acknowledgments(std::chrono::minutes(1));
  }

 private:
  runtime::DdsTransport transport_;
  std::unique_ptr<runtime::Writer> writer_;
};

template <class Message>
void record(benchmark::State& state, const Message& message, std::size_t bytes, const Load& load) {
  const std::uint64_t count = load.messages * static_cast<std::uint64_t>(load.writers);
  double lost = 0;
  double recorder = 0;
  double writers = 0;
  double wall = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const test::TemporaryFolder folder;
    std::vector<std::unique_ptr<Talker>> talkers;
    for (int i = 0; i < load.writers; ++i) {
      talkers.push_back(std::make_unique<Talker>(runtime::message_type<Message>()));
    }
    Recorder program(folder.path());
    for (const auto& talker : talkers) talker->wait_for_reader();
    recorder -= processor_seconds(RUSAGE_CHILDREN);
    writers -= processor_seconds(RUSAGE_SELF);
    state.ResumeTiming();
    const auto begin = std::chrono::steady_clock::now();
    {
      std::vector<std::jthread> threads;
      for (const auto& talker : talkers) {
        threads.emplace_back([&talker, &message, &load] { talker->talk(&message, load); });
      }
    }
    state.PauseTiming();
    wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    writers += processor_seconds(RUSAGE_SELF);
    const std::string said = program.finish();
    recorder += processor_seconds(RUSAGE_CHILDREN);
    const std::uint64_t taken = messages_in(folder.path() / "captures");
    if (taken < count) std::fputs(said.c_str(), stderr);
    lost += static_cast<double>(count - taken);
    state.ResumeTiming();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
  state.SetBytesProcessed(static_cast<std::int64_t>(count * bytes) * state.iterations());
  state.counters["lost"] = lost;
  state.counters["recorder_cpu"] = recorder / wall;
  state.counters["writer_cpu"] = writers / wall;
}

/// Argument: writers.
void RecordSmallMessages(benchmark::State& state) {
  std_msgs::msg::String message;
  message.data(std::string(64, 'x'));
  const auto writers = static_cast<int>(state.range(0));
  record(state, message, 64,
         {.writers = writers, .messages = 200'000U / static_cast<unsigned>(writers)});
}
BENCHMARK(RecordSmallMessages)
    ->ArgName("writers")
    ->Arg(1)
    ->Arg(2)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Argument: MB a second.
void RecordImages(benchmark::State& state) {
  sensor_msgs::msg::Image image;
  image.data().resize(std::size_t{1} << 20U);
  for (std::size_t i = 0; i < image.data().size(); ++i) {
    image.data()[i] = static_cast<std::uint8_t>((i * 2654435761U) >> 13U);
  }
  const double rate = 1e6 * static_cast<double>(state.range(0));
  const auto period = std::chrono::nanoseconds(
      static_cast<std::int64_t>(1e9 * static_cast<double>(image.data().size()) / rate));
  record(state, image, image.data().size(), {.messages = 2000, .period = period});
}
BENCHMARK(RecordImages)
    ->ArgName("MB_per_s")
    ->Arg(300)
    ->Arg(600)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::capture
