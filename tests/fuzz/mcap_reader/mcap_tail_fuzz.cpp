/// Any bytes as a capture and what its writer had in memory when it was killed: read and recovered
/// together as mcap_reader_fuzz does with a capture alone. The first four bytes of an input are the
/// length of the capture; the tail is behind it. Seeds as there:
///   COOP_FUZZ_SEEDS=corpus mcap_tail_fuzz corpus -max_total_time=600 -rss_limit_mb=1024
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "fuzz/mcap_reader/use_file.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace coop::mcap;
using namespace coop::mcap::fuzz;

constexpr std::size_t kSlot = 600;

Message message(std::uint32_t number, Bytes data) {
  return {static_cast<std::uint16_t>(1 + number % 2), number, number, number, data};
}

void define(ChunkBuilder& chunk) {
  chunk.add(Schema{1, "std_msgs/msg/String", "ros2msg", "string data"});
  chunk.add(Channel{1, 1, "/a", "cdr", {}});
  chunk.add(Channel{2, 0, "/b", "json", {}});
}

std::vector<std::byte> bytes_of_file(const std::filesystem::path& path) {
  const auto file = open_plain_file(path);
  std::vector<std::byte> bytes(file->size());
  file->read(0, bytes);
  return bytes;
}

/// `written`: of two chunks in the tail, so many are in the capture too. Ended in mid-chunk where
/// `cut` bytes are missing.
void write_seed(const std::filesystem::path& path, std::size_t written, std::size_t cut) {
  const coop::test::TemporaryFolder folder;
  std::vector<std::byte> capture;
  FileWriter file(write_to_memory(capture), {"ros2", "seed"});
  Tail tail(folder.path() / "a.tail");
  Compressor none(Compression::kNone, 0);
  ByteBuffer buffer;
  const std::string text = "some text";
  std::uint32_t number = 0;
  std::vector<std::unique_ptr<ChunkBuilder>> chunks;
  for (std::size_t i = 0; i < 2; ++i) {
    auto chunk = std::make_unique<ChunkBuilder>(Padding::kNone, tail.add_slot(kSlot));
    chunk->reserve(kSlot);
    if (i == 0) define(*chunk);
    for (; number < 3 * (i + 1); ++number) {
      chunk->add(message(number, std::as_bytes(std::span(text))));
    }
    if (i < written) file.add(make_ready(*chunk, none, buffer));
    chunks.push_back(std::move(chunk));
  }
  const std::vector<std::byte> of_tail = bytes_of_file(folder.path() / "a.tail");
  ByteBuffer input;
  const std::size_t length = capture.size() - cut;
  input.u32(static_cast<std::uint32_t>(length));
  input.raw(Bytes(capture).first(length));
  input.raw(of_tail);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()),
             static_cast<std::streamsize>(input.size()));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  if (const char* folder = std::getenv("COOP_FUZZ_SEEDS")) {
    for (std::size_t written = 0; written <= 2; ++written) {
      const std::filesystem::path path(folder);
      write_seed(path / ("tail_seed" + std::to_string(written)), written, 0);
      if (written > 0) write_seed(path / ("cut_seed" + std::to_string(written)), written, 50);
    }
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  if (size < 4) return 0;
  const auto length = static_cast<std::size_t>(data[0]) | static_cast<std::size_t>(data[1]) << 8U |
                      static_cast<std::size_t>(data[2]) << 16U;
  const Bytes capture = bytes.subspan(4, std::min(length, size - 4));
  const Bytes rest = bytes.subspan(4 + capture.size());
  const auto tail = chunks_of_tail(*open_memory({rest.begin(), rest.end()}), 64U << 10U);
  const auto both = with_tail(open_memory({capture.begin(), capture.end()}), tail);
  read_all(both, {}, false);
  read_all(both, {1, 4, {"/a"}, Order::kFile}, false);
  recover_and_read(both);
  return 0;
}
