/// Any bytes as a file: read by index and by scan, recovered, and the recovered file read again.
/// What is no FileError is a finding. With COOP_FUZZ_SEEDS=DIR small valid files are written there
/// first:
///   COOP_FUZZ_SEEDS=corpus mcap_reader_fuzz corpus -max_total_time=600 -rss_limit_mb=1024
#include <fstream>

#include "fuzz/mcap_reader/use_file.hpp"

namespace {

using namespace coop::mcap;
using namespace coop::mcap::fuzz;

void write_seed(const std::string& path, Compression compression, bool checksums, bool chunked) {
  std::vector<std::byte> bytes;
  FileWriter file(write_to_memory(bytes), {"ros2", "seed"});
  file.add(Schema{1, "std_msgs/msg/String", "ros2msg", "string data"});
  file.add(Channel{1, 1, "/a", "cdr", {{"offered_qos_profiles", ""}}});
  file.add(Channel{2, 0, "/b", "json", {}});
  const std::string text = "some text";
  const Bytes data = std::as_bytes(std::span(text));
  file.add(Attachment{1, 2, "name", "text/plain", data});
  file.add(Metadata{"versions", {{"coop", "0.1.0"}}});
  ChunkBuilder chunk;
  Compressor compressor(compression, 1);
  ByteBuffer buffer;
  for (std::uint16_t i = 0; i < 6; ++i) {
    const Message message{static_cast<std::uint16_t>(1 + i % 2), i, Nanoseconds{i} * 7 % 5, i,
                          data};
    if (!chunked) {
      file.add(message);
      continue;
    }
    chunk.add(message);
    if (i % 3 == 2) {
      file.add(make_ready(chunk, compressor, buffer, checksums));
      chunk.clear();
    }
  }
  file.finish();
  if (!checksums) {
    for (std::size_t i = 9; i <= 12; ++i) bytes[bytes.size() - i] = std::byte{0};  // the footer's
  }
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  if (const char* folder = std::getenv("COOP_FUZZ_SEEDS")) {
    int number = 0;
    for (const auto compression : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
      for (const bool checksums : {false, true}) {
        write_seed(std::string(folder) + "/seed" + std::to_string(number++), compression, checksums,
                   true);
      }
    }
    write_seed(std::string(folder) + "/seed_loose", Compression::kNone, false, false);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto source = open_memory({bytes.begin(), bytes.end()});
  read_all(source, {}, false);
  read_all(source, {1, 4, {"/a"}, Order::kFile}, false);
  recover_and_read(source);
  return 0;
}
