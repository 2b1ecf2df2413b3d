/// Captures killed at random moments. COOP_MCAP_KILLS: how many (20).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <random>

#include "capture/mcap/recover.hpp"
#include "capture/mcap/ring_rescue.hpp"
#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"

namespace coop::mcap {
namespace {

/// What the child tells before it is killed.
struct Progress {
  std::atomic<std::uint64_t> taken{0};  // messages that write() has accepted
};

class SharedProgress {
 public:
  SharedProgress() {
    void* memory = ::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE,
                          MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    progress_ = new (memory) Progress;
  }
  ~SharedProgress() { ::munmap(progress_, sizeof(Progress)); }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;
  Progress* operator->() { return progress_; }
  Progress& operator*() { return *progress_; }

 private:
  Progress* progress_;
};

/// How one capture is made; all of it from the seed.
struct Plan {
  WriterOptions options;
  std::size_t message_size = 0;
  std::size_t large_size = 0;  ///< of every so many messages: larger than a chunk
  std::uint64_t large_every = 0;
  useconds_t lifetime = 0;

  explicit Plan(unsigned seed) {
    std::mt19937 random(seed);
    const auto pick = [&](std::size_t low, std::size_t high) {
      return std::uniform_int_distribution<std::size_t>(low, high)(random);
    };
    constexpr std::array kAll{Compression::kNone, Compression::kLz4, Compression::kZstd};
    options.compression = kAll[pick(0, 2)];
    options.chunk_bytes = pick(4'000, 400'000);
    // One chunk being filled and one on its way: the least there can be.
    options.queue_bytes = 1;
    options.when_full = WhenFull::kWait;
    options.tail = true;
    message_size = pick(10, 3'000);
    large_size = pick(options.chunk_bytes, 4 * options.chunk_bytes);
    large_every = pick(10, 1'000);
    lifetime = static_cast<useconds_t>(pick(0, 40'000));
  }
};

/// Where it captures to: files, or a ring.
template <class Target>
[[noreturn]] void capture_until_killed(const Plan& plan, const Target& target, Progress& progress) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  Writer writer(target, plan.options);
  const std::uint16_t channel = writer.add_channel(writer.add_schema("a", "ros2msg", "b"), "/a");
  std::string text(plan.large_size, ' ');
  std::mt19937 random(1);
  for (char& c : text) c = static_cast<char>(random());
  const Bytes all = test::bytes_of(text);
  for (std::uint64_t i = 0;; ++i) {
    text[i % plan.message_size] = static_cast<char>(random());
    const bool is_large = i % plan.large_every == plan.large_every - 1;
    writer.write({channel, static_cast<std::uint32_t>(i), i, i,
                  is_large ? all : all.first(plan.message_size)});
    progress.taken = i + 1;
  }
}

template <class Target>
void capture_and_kill(const Plan& plan, const Target& target, Progress& progress) {
  const pid_t child = ::fork();
  if (child == 0) capture_until_killed(plan, target, progress);
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  ::usleep(plan.lifetime);  // the random moment
  ::kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
}

/// Runs the capture and kills it. False where the file was not even there yet.
bool capture_and_kill_file(const Plan& plan, const std::filesystem::path& path,
                           Progress& progress) {
  capture_and_kill(plan, Series{path}, progress);
  return std::filesystem::exists(path) &&
         std::filesystem::file_size(path) > kMagic.size() + kRecordPrefix;
}

int kills_wanted() {
  const char* wanted = std::getenv("COOP_MCAP_KILLS");
  return wanted == nullptr ? 20 : std::atoi(wanted);
}

TEST(Kill, ACaptureKilledAtAnyMomentHasEveryMessageThatWasTaken) {
  const int kills = kills_wanted();
  const coop::test::TemporaryFolder folder;
  int begun = 0;
  int cut = 0;
  std::uint64_t taken = 0;
  std::uint64_t missing = 0;
  for (int i = 0; i < kills; ++i) {
    const Plan plan(static_cast<unsigned>(i));
    const auto path = folder.path() / (std::to_string(i) + ".mcap");
    SharedProgress progress;
    if (!capture_and_kill_file(plan, path, *progress)) continue;
    ++begun;
    std::vector<std::byte> bytes;
    const RecoverReport report = recover(open_file(path), write_to_memory(bytes));
    std::filesystem::remove(path);
    Reader reader(open_memory(std::move(bytes)));
    ASSERT_TRUE(reader.summary().complete);
    std::uint64_t next = 0;
    MessageCursor cursor = reader.messages();
    while (const auto read = cursor.next()) ASSERT_EQ(read->message.sequence, next++) << "a gap";
    EXPECT_LE(report.lost_chunks, 1U) << "seed " << i;
    EXPECT_GE(next, progress->taken) << "seed " << i;
    cut += report.lost_chunks > 0 ? 1 : 0;
    taken += progress->taken;
    missing += progress->taken > next ? progress->taken - next : 0;
  }
  EXPECT_GE(begun, kills / 2);
  std::printf(
      "%d captures killed, %d had begun their file, %d were cut inside a chunk; %llu messages "
      "written, %llu of them missing\n",
      kills, begun, cut, static_cast<unsigned long long>(taken),
      static_cast<unsigned long long>(missing));
}

TEST(Kill, ARingKilledAtAnyMomentBecomesACaptureOfTheLastSeconds) {
  const int kills = kills_wanted();
  const coop::test::TemporaryFolder folder;
  int begun = 0;
  std::uint64_t taken = 0;
  for (int i = 0; i < kills; ++i) {
    const Plan plan(static_cast<unsigned>(i));
    const auto name = std::to_string(i);
    const Ring ring{.duration = ~Nanoseconds{0},
                    .max_bytes = 20 * plan.options.chunk_bytes,
                    .folder = folder.path() / ("coop-ring-" + name),
                    .origin = folder.path() / "captures" / (name + ".mcap")};
    SharedProgress progress;
    capture_and_kill(plan, ring, *progress);
    std::uint64_t written = 0;
    for (DeadRing& dead : DeadRing::all_in(folder.path()))
      written = dead.write({"killed", {}}).messages;
    EXPECT_FALSE(std::filesystem::exists(ring.folder));
    if (written == 0) {
      EXPECT_EQ(progress->taken, 0U) << "seed " << i;
      continue;
    }
    ++begun;
    Reader reader(ring.origin);
    ASSERT_TRUE(reader.summary().complete);
    MessageCursor cursor = reader.messages();
    std::optional<std::uint64_t> next;
    while (const auto read = cursor.next()) {
      if (!next) next = read->message.sequence;
      ASSERT_EQ(read->message.sequence, (*next)++) << "a gap";
    }
    EXPECT_GE(*next, progress->taken) << "seed " << i;
    taken += progress->taken;
    std::filesystem::remove(ring.origin);
  }
  EXPECT_GT(begun, 0);
  std::printf("%d rings killed, %d had begun; each was there to the last of its messages (%llu)\n",
              kills, begun, static_cast<unsigned long long>(taken));
}

}  // namespace
}  // namespace coop::mcap
