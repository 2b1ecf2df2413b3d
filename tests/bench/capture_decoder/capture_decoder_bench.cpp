// What it costs to look into messages: a scan of 720 beams, a message of 100 transforms, an image
// of 640 x 480 (bytes_per_second counts the payload).
#include <benchmark/benchmark.h>

#include <functional>

#include "capture/schema/cdr_walk.hpp"
#include "capture/schema/definitions.hpp"
#include "capture/schema/message_text.hpp"
#include "capture/schema/payload_difference.hpp"
#include "unit/capture_schema/cdr_bytes.hpp"

namespace coop::capture {
namespace {

using test::CdrBytes;

MessageLayout layout_of(const char* type) {
  return {type, *ros2msg_definition(type)};
}

CdrBytes header() {
  CdrBytes bytes;
  return bytes.put(std::int32_t{1'700'000'000}).put(std::uint32_t{123'456'789}).text("laser_link");
}

CdrBytes scan() {
  CdrBytes bytes = header();
  for (int i = 0; i < 7; ++i) bytes.put(0.5F);
  bytes.length(720);
  for (int i = 0; i < 720; ++i) bytes.put(1.0F + 0.01F * static_cast<float>(i));
  return bytes.length(0);
}

CdrBytes transforms() {
  CdrBytes bytes;
  bytes.length(100);
  for (int i = 0; i < 100; ++i) {
    bytes.put(std::int32_t{i}).put(std::uint32_t{0}).text("base_link").text("arm_link");
    for (int k = 0; k < 7; ++k) bytes.put(0.1 * k);
  }
  return bytes;
}

CdrBytes image() {
  CdrBytes bytes = header();
  bytes.put(std::uint32_t{480}).put(std::uint32_t{640}).text("rgb8").put(std::uint8_t{0});
  bytes.put(std::uint32_t{1920}).length(480 * 1920);
  for (int i = 0; i < 480 * 1920; ++i) bytes.put(static_cast<std::uint8_t>(i));
  return bytes;
}

/// Takes everything in and keeps nothing.
struct Listener {
  double sum = 0;
  void begin_message(const FieldLayout& /*field*/, std::size_t /*index*/) {}
  void end_message(const FieldLayout& /*field*/) {}
  void begin_array(const FieldLayout& /*field*/, std::size_t /*count*/) {}
  void end_array(const FieldLayout& /*field*/) {}
  void text(const FieldLayout& /*field*/, std::size_t /*index*/, std::string_view value) {
    sum += static_cast<double>(value.size());
  }
  void number(const FieldLayout& /*field*/, const Number& value) { sum += value.as_double(); }
  void numbers(const FieldLayout& /*field*/, const NumberArray& values) {
    sum += static_cast<double>(values.size());
  }
};

struct Subject {
  MessageLayout layout;
  CdrBytes payload;
};

void run(benchmark::State& state, const Subject& subject,
         const std::function<bool(const Subject&)>& work) {
  std::int64_t bytes = 0;
  for (auto _ : state) {
    if (!work(subject)) state.SkipWithError("malformed");
    bytes += static_cast<std::int64_t>(std::span<const std::byte>(subject.payload).size());
  }
  state.SetBytesProcessed(bytes);
}

bool walk_through(const Subject& subject) {
  Listener listener;
  const bool read = walk(subject.layout, subject.payload, listener).has_value();
  benchmark::DoNotOptimize(listener.sum);
  return read;
}

bool to_json(const Subject& subject) {
  static std::string text;
  text.clear();
  return append_json(subject.layout, subject.payload, {}, text).has_value();
}

/// The last number differs, so everything has to be looked at.
bool compare(const Subject& subject) {
  static std::vector<std::byte> other;
  const std::span<const std::byte> payload = subject.payload;
  other.assign(payload.begin(), payload.end());
  other[other.size() - 8] ^= std::byte{1};
  return first_difference(subject.layout, payload, other).has_value();
}

const std::pair<const char*, Subject>* subjects() {
  static const std::pair<const char*, Subject> kSubjects[] = {
      {"scan", {layout_of("sensor_msgs/LaserScan"), scan()}},
      {"transforms", {layout_of("tf2_msgs/TFMessage"), transforms()}},
      {"image", {layout_of("sensor_msgs/Image"), image()}}};
  return kSubjects;
}

const bool kRegistered = [] {
  for (int i = 0; i < 3; ++i) {
    const auto& [name, subject] = subjects()[i];
    for (const auto& [verb, work] :
         {std::pair<std::string, bool (*)(const Subject&)>{"walk", walk_through},
          {"json", to_json},
          {"compare", compare}}) {
      benchmark::RegisterBenchmark((verb + "/" + name).c_str(),
                                   [&subject = subject, work = work](benchmark::State& state) {
                                     run(state, subject, work);
                                   });
    }
  }
  return true;
}();

}  // namespace
}  // namespace coop::capture
