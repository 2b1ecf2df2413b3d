/// Writing of images and of small messages; opening of a large file, and seeking in it. Times are
/// processor times of all threads (the machine may be busy), and of the writing thread alone.
/// COOP_MCAP_GB: size of the large file, GB (10). It is sparse: the images in it are zeros that
/// take no room on the disk, so that what is measured is the reader and not the disk.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <system_error>

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

/// Leaves holes where the images are.
class SparseSink final : public Sink {
 public:
  explicit SparseSink(const std::filesystem::path& path)
      : fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {
    if (fd_ < 0) throw std::system_error(errno, std::generic_category(), path.string());
  }
  ~SparseSink() override { ::close(fd_); }
  SparseSink(const SparseSink&) = delete;
  SparseSink& operator=(const SparseSink&) = delete;

  void write(std::span<const Bytes> parts) override {
    for (const Bytes part : parts) {
      const std::size_t head = std::min<std::size_t>(part.size(), 4096);
      put(part.first(head));
      Bytes rest = part.subspan(head);
      if (!rest.empty() &&
          std::ranges::all_of(rest, [](std::byte b) { return b == std::byte{0}; })) {
        // But for one byte, which makes the file as long as it should be.
        if (::lseek(fd_, static_cast<off_t>(rest.size() - 1), SEEK_CUR) < 0) fail();
        rest = rest.last(1);
      }
      put(rest);
    }
  }
  void sync() override {}

 private:
  void put(Bytes bytes) const {
    if (::write(fd_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) fail();
  }
  [[noreturn]] static void fail() {
    throw std::system_error(errno, std::generic_category(), "the large file");
  }

  int fd_;
};

/// Images at 10 Hz on three topics and scans between them, in chunks of 4 MB.
class LargeFile {
 public:
  static const LargeFile& get() {
    static const LargeFile file;
    return file;
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "large.mcap"; }
  [[nodiscard]] Nanoseconds duration() const { return duration_; }

 private:
  LargeFile() {
    const char* wanted = std::getenv("COOP_MCAP_GB");
    const std::uint64_t size = std::uint64_t{1'000'000'000} *
                               (wanted == nullptr ? 10 : std::strtoull(wanted, nullptr, 10));
    Layout layout;
    layout.data_crc = false;
    FileWriter file(std::make_unique<SparseSink>(path()), {"ros2", "bench"}, layout);
    file.add(Schema{1, "sensor_msgs/msg/Image", "ros2msg", std::string(2000, 'x')});
    for (std::uint16_t id = 1; id <= 20; ++id) {
      file.add(Channel{id, 1, "/topic" + std::to_string(id), "cdr", {}});
    }
    Compressor none(Compression::kNone, 0);
    ByteBuffer buffer;
    ChunkBuilder chunk;
    chunk.reserve(std::size_t{5} << 20U);
    const std::vector<std::byte> image(kImageBytes * 4 + 50'000);
    while (file.size() < size) {
      chunk.clear();
      for (std::uint16_t id = 1; id <= 20; ++id) {
        chunk.add(Message{id, 0, duration_ + id, duration_, Bytes(image).first(100)});
      }
      chunk.add(Message{1, 0, duration_ + 50, duration_, image});
      duration_ += 100 * kMillisecond;
      file.add(make_ready(chunk, none, buffer, false));
    }
    file.finish();
  }

  coop::test::TemporaryFolder folder_;
  Nanoseconds duration_ = 0;
};

void open_large_file(benchmark::State& state) {
  const LargeFile& file = LargeFile::get();
  for (auto _ : state) {
    Reader reader(file.path());
    benchmark::DoNotOptimize(reader.summary().statistics->message_count);
    state.counters["GB"] = 1e-9 * static_cast<double>(reader.source().size());
    state.counters["chunks"] = static_cast<double>(reader.summary().chunks.size());
  }
}
BENCHMARK(open_large_file)->Unit(benchmark::kMillisecond);

void seek_in_large_file(benchmark::State& state) {
  const LargeFile& file = LargeFile::get();
  Reader reader(file.path());
  std::mt19937_64 random(1);
  std::uniform_int_distribution<Nanoseconds> time(0, file.duration() - 100 * kMillisecond);
  for (auto _ : state) {
    MessageCursor cursor = reader.messages({.start = time(random)});
    benchmark::DoNotOptimize(cursor.next());
  }
}
BENCHMARK(seek_in_large_file)->Unit(benchmark::kMillisecond);

/// From nothing: the file is opened, too.
void open_and_seek_in_large_file(benchmark::State& state) {
  const LargeFile& file = LargeFile::get();
  std::mt19937_64 random(1);
  std::uniform_int_distribution<Nanoseconds> time(0, file.duration() - 100 * kMillisecond);
  for (auto _ : state) {
    Reader reader(file.path());
    MessageCursor cursor = reader.messages({.start = time(random), .topics = {"/topic7"}});
    benchmark::DoNotOptimize(cursor.next());
  }
}
BENCHMARK(open_and_seek_in_large_file)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace coop::mcap
