/// Writing of images and of small messages; opening of a large file, and seeking in it. Times are
/// processor times of all threads (the machine may be busy), and of the writing thread alone; of
/// the large file also by the clock, in memory (warm) and read from the disk (cold).
/// COOP_MCAP_GB: size of the large file, GB (1). It is written to the disk, and taken away again.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "capture/mcap/reader.hpp"
#include "capture/mcap/writer.hpp"
#include "support/temporary_folder.hpp"

namespace coop::mcap {
namespace {

constexpr std::size_t kImageBytes = 640 * 480 * 3;
constexpr Nanoseconds kMillisecond = 1'000'000;

double seconds_of(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Processor time since its making.
class Stopwatch {
 public:
  [[nodiscard]] double process() const { return seconds_of(CLOCK_PROCESS_CPUTIME_ID) - process_; }
  [[nodiscard]] double thread() const { return seconds_of(CLOCK_THREAD_CPUTIME_ID) - thread_; }

 private:
  double process_ = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  double thread_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
};

std::vector<std::byte> noise(std::size_t size) {
  std::vector<std::byte> bytes(size);
  std::mt19937_64 random(1);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

/// Reports how much a second of processor time takes: of all threads, and of the writing one.
class Rates {
 public:
  void add(const Stopwatch& watch, double amount) {
    all_ += watch.process();
    own_ += watch.thread();
    amount_ += amount;
  }
  void report(benchmark::State& state, const std::string& unit) const {
    state.counters[unit + "_per_s"] = amount_ / all_;
    state.counters[unit + "_per_s_of_caller"] = amount_ / own_;
  }

 private:
  double all_ = 0;
  double own_ = 0;
  double amount_ = 0;
};

void write_images(benchmark::State& state) {
  constexpr int kImages = 400;
  const coop::test::TemporaryFolder folder;
  const std::vector<std::byte> image = noise(kImageBytes);
  Rates rates;
  for (auto _ : state) {
    const auto path = folder.path() / "images.mcap";
    WriterOptions options;
    options.compression = Compression::kNone;
    options.when_full = WhenFull::kWait;
    options.file.layout.data_crc = state.range(0) != 0;
    options.tail = state.range(1) != 0;
    const Stopwatch watch;
    {
      Writer writer(Series{path}, options);
      const std::uint16_t channel = writer.add_channel(0, "/camera/image");
      for (int i = 0; i < kImages; ++i) {
        const Nanoseconds time = static_cast<Nanoseconds>(i) * 100 * kMillisecond;
        writer.write({channel, 0, time, time, image});
      }
    }
    rates.add(watch, 1e-6 * kImages * static_cast<double>(kImageBytes));
    std::filesystem::remove(path);
  }
  rates.report(state, "MB");
}
BENCHMARK(write_images)
    ->ArgNames({"data_crc", "tail"})
    ->Args({0, 0})
    ->Args({0, 1})
    ->Args({1, 0})
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void write_small_messages(benchmark::State& state) {
  constexpr int kMessages = 200'000;
  const coop::test::TemporaryFolder folder;
  constexpr std::array kCompressions{Compression::kNone, Compression::kLz4, Compression::kZstd};
  std::vector<std::byte> data = noise(100);
  Rates rates;
  for (auto _ : state) {
    const auto path = folder.path() / "small.mcap";
    WriterOptions options;
    options.compression = kCompressions[static_cast<std::size_t>(state.range(0))];
    options.when_full = WhenFull::kWait;
    options.tail = state.range(1) != 0;
    const Stopwatch watch;
    {
      Writer writer(Series{path}, options);
      std::vector<std::uint16_t> channels;
      for (int i = 0; i < 20; ++i) {
        channels.push_back(writer.add_channel(0, "/topic" + std::to_string(i)));
      }
      for (int i = 0; i < kMessages; ++i) {
        const Nanoseconds time = static_cast<Nanoseconds>(i) * 10'000;
        const auto sequence = static_cast<std::uint32_t>(i);
        data[sequence % data.size()] = static_cast<std::byte>(i >> 3);
        writer.write({channels[sequence % channels.size()], sequence, time, time, data});
      }
    }
    rates.add(watch, kMessages);
    std::filesystem::remove(path);
  }
  rates.report(state, "messages");
}
BENCHMARK(write_small_messages)
    ->ArgNames({"none_lz4_zstd", "tail"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}})
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

/// Images of a camera at 10 Hz, and small messages between them.
class LargeFile {
 public:
  static const LargeFile& get() {
    static const LargeFile file;
    return file;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] Nanoseconds duration() const { return duration_; }
  /// What of it is in memory goes.
  void forget() const {
    if (::posix_fadvise(fd_, 0, 0, POSIX_FADV_DONTNEED) != 0) {
      throw std::runtime_error("the large file stays in memory");
    }
  }
  LargeFile(const LargeFile&) = delete;
  LargeFile& operator=(const LargeFile&) = delete;

 private:
  LargeFile() {
    const char* wanted = std::getenv("COOP_MCAP_GB");
    const std::uint64_t size =
        std::uint64_t{1'000'000'000} * (wanted == nullptr ? 1 : std::strtoull(wanted, nullptr, 10));
    const std::vector<std::byte> image = noise(kImageBytes);
    WriterOptions options;
    options.compression = Compression::kNone;
    options.when_full = WhenFull::kWait;
    options.file.sync = Sync::kEachFile;
    Writer writer(Series{path_}, options);
    const auto schema =
        writer.add_schema("sensor_msgs/msg/Image", "ros2msg", std::string(2000, 'x'));
    std::vector<std::uint16_t> channels;
    for (int id = 0; id <= 20; ++id) {
      channels.push_back(writer.add_channel(schema, "/topic" + std::to_string(id)));
    }
    for (std::uint64_t written = 0; written < size; written += image.size()) {
      for (std::size_t i = 1; i < channels.size(); ++i) {
        writer.write({channels[i], 0, duration_ + i, duration_, Bytes(image).first(100)});
      }
      writer.write({channels[0], 0, duration_ + 50, duration_, image});
      duration_ += 100 * kMillisecond;
    }
    writer.close();
    fd_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  }
  ~LargeFile() { ::close(fd_); }

  coop::test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "large.mcap";
  Nanoseconds duration_ = 0;
  int fd_ = -1;
};

/// `use(time)` with a random time of the file, again and again.
template <class Use>
void measure(benchmark::State& state, const Use& use) {
  const LargeFile& file = LargeFile::get();
  const bool cold = state.range(0) != 0;
  std::mt19937_64 random(1);
  std::uniform_int_distribution<Nanoseconds> time(0, file.duration() - 200 * kMillisecond);
  double longest = 0;
  for (auto _ : state) {
    if (cold) {
      state.PauseTiming();
      file.forget();
      state.ResumeTiming();
    }
    const double begin = seconds_of(CLOCK_MONOTONIC);
    use(time(random));
    longest = std::max(longest, seconds_of(CLOCK_MONOTONIC) - begin);
  }
  state.counters["longest_ms"] = 1e3 * longest;
  state.counters["GB"] = 1e-9 * static_cast<double>(std::filesystem::file_size(file.path()));
}

void open_large_file(benchmark::State& state) {
  measure(state, [&](Nanoseconds) {
    Reader reader(LargeFile::get().path());
    benchmark::DoNotOptimize(reader.summary().statistics->message_count);
    state.counters["chunks"] = static_cast<double>(reader.summary().chunks.size());
  });
}
BENCHMARK(open_large_file)
    ->ArgName("cold")
    ->Arg(0)
    ->Arg(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void seek_in_large_file(benchmark::State& state) {
  Reader reader(LargeFile::get().path());
  measure(state, [&](Nanoseconds time) {
    MessageCursor cursor = reader.messages({.start = time});
    benchmark::DoNotOptimize(cursor.next());
  });
}
BENCHMARK(seek_in_large_file)
    ->ArgName("cold")
    ->Arg(0)
    ->Arg(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// From nothing: the file is opened, too.
void open_and_seek_in_large_file(benchmark::State& state) {
  measure(state, [&](Nanoseconds time) {
    Reader reader(LargeFile::get().path());
    MessageCursor cursor = reader.messages({.start = time, .topics = {"/topic7"}});
    benchmark::DoNotOptimize(cursor.next());
  });
}
BENCHMARK(open_and_seek_in_large_file)
    ->ArgName("cold")
    ->Arg(0)
    ->Arg(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::mcap
