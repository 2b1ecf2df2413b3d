/// write() is called for each message of the robot: once warm, it takes no memory.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "support/temporary_folder.hpp"
#include "unit/capture_mcap/capture.hpp"

namespace {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCounting = false;  // they have allocators of their own
#else
constexpr bool kCounting = true;
#endif
thread_local std::size_t allocations = 0;
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif

namespace coop::mcap {
namespace {

TEST(Allocation, WritingAMessageTakesNoMemory) {
  if (!kCounting) GTEST_SKIP() << "not run: sanitizers have allocators of their own";
  const coop::test::TemporaryFolder folder;
  WriterOptions options;
  options.chunk_bytes = 100'000;
  options.queue_bytes = 1;  // two chunks, used again and again
  options.when_full = WhenFull::kWait;
  Writer writer(Series{folder.path() / "a.mcap"}, options);
  const std::uint16_t channel = writer.add_channel(0, "/a");
  const std::string text(100, 'x');
  const auto write = [&](std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      writer.write({channel, i, i, i, test::bytes_of(text)});
    }
  };
  write(10'000);
  const std::size_t before = allocations;
  write(10'000);
  // 13 chunks were handed over in between, each as a job in a queue.
  EXPECT_LE(allocations - before, 20U);
}

}  // namespace
}  // namespace coop::mcap
