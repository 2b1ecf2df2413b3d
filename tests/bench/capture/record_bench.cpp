// How much the recorder takes in over DDS on one machine, with nothing lost: small messages as fast
// as the recorder follows (the writer is reliable and keeps everything), and images at a rate.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

#include "capture/mcap/reader.hpp"
#include "capture/node/record_node.hpp"
#include "runtime/dds_transport.hpp"
#include "sensor_msgs/msg/Image.h"
#include "std_msgs/msg/String.h"
#include "support/temporary_folder.hpp"

namespace coop::capture {
namespace {

constexpr int kDomain = 25;

/// A recorder at work on a thread of its own.
class Recorder {
 public:
  explicit Recorder(const std::filesystem::path& folder)
      : transport_({.domain = kDomain, .participant_name = "record", .partition = {}}),
        executor_(clock_),
        node_(options(), transport_, clock_, executor_),
        record_(std::in_place, node_, config(folder)),
        thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) executor_.wait_and_run(std::chrono::milliseconds(20));
        }) {}
  void finish() {
    thread_.request_stop();
    thread_.join();
    node_.stop();
    record_.reset();
  }

 private:
  static runtime::Options options() {
    runtime::Options options;
    options.name = "record";
    options.domain = kDomain;
    return options;
  }
  static RecordConfig config(const std::filesystem::path& folder) {
    RecordConfig config;
    config.output = folder;
    config.topics = {"/bench"};
    config.compression = "lz4";
    return config;
  }
  runtime::DdsTransport transport_;
  runtime::SystemClock clock_;
  runtime::Executor executor_;
  runtime::Node node_;
  std::optional<RecordNode> record_;
  std::jthread thread_;
};

std::uint64_t messages_in(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    return mcap::Reader(entry.path()).summary().statistics->message_count;
  }
  return 0;
}

/// `period` between two messages; 0: none.
template <class Message>
void record(benchmark::State& state, const Message& message, std::uint64_t count, std::size_t bytes,
            std::chrono::nanoseconds period = {}) {
  std::uint64_t lost = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const test::TemporaryFolder folder;
    runtime::DdsTransport transport(
        {.domain = kDomain, .participant_name = "talker", .partition = {}});
    const auto writer =
        transport.create_writer("bench", runtime::message_type<Message>(), runtime::Qos::kEvent);
    Recorder recorder(folder.path());
    while (writer->matched_readers() == 0) std::this_thread::yield();
    state.ResumeTiming();
    auto due = std::chrono::steady_clock::now();
    for (std::uint64_t i = 0; i < count; ++i) {
      std::this_thread::sleep_until(due += period);
      while (!writer->write(&message)) std::this_thread::yield();
    }
    writer->wait_for_acknowledgments(std::chrono::minutes(1));
    state.PauseTiming();
    recorder.finish();
    lost += count - messages_in(folder.path());
    state.ResumeTiming();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
  state.SetBytesProcessed(static_cast<std::int64_t>(count * bytes) * state.iterations());
  state.counters["lost"] = static_cast<double>(lost);
}

void RecordSmallMessages(benchmark::State& state) {
  std_msgs::msg::String message;
  message.data(std::string(64, 'x'));
  record(state, message, 200'000, 64);
}
BENCHMARK(RecordSmallMessages)
    ->Iterations(1)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
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
  record(state, image, 2000, image.data().size(), period);
}
BENCHMARK(RecordImages)
    ->ArgName("MB_per_s")
    ->Arg(300)
    ->Arg(600)
    ->Iterations(1)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::capture
