#include "capture/mcap/chunk_search.hpp"

#include <algorithm>
#include <cstring>

namespace coop::mcap {
namespace {

/// Content of a Chunk up to its records, with the longest name of a compression.
constexpr std::uint64_t kLongestHead = 8 + 8 + 8 + 4 + 4 + 4 + 8;
constexpr std::uint64_t kSearchWindow = std::uint64_t{1} << 20U;

bool is_chunk_head(Bytes content, std::uint64_t content_length) {
  try {
    const ChunkHead head = decode_chunk_head({Opcode::kChunk, 0, content}, content_length);
    const Chunk& chunk = head.chunk;
    const bool known =
        chunk.compression.empty() || chunk.compression == "zstd" || chunk.compression == "lz4";
    return known && head.records_offset + head.records_size == content_length &&
           chunk.message_start_time <= chunk.message_end_time;
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace

bool is_plausible_record(RecordStream& stream, std::uint64_t offset) {
  if (offset > stream.end() || stream.end() - offset < kRecordPrefix) return false;
  const std::uint64_t left = stream.end() - offset - kRecordPrefix;
  const Bytes prefix = stream.bytes(offset, kRecordPrefix);
  const auto opcode = static_cast<Opcode>(prefix[0]);
  const std::uint64_t length = load_u64(prefix.subspan(1));
  if (opcode < Opcode::kHeader || opcode > Opcode::kDataEnd || length > left) return false;
  if (opcode != Opcode::kChunk) return true;
  return is_chunk_head(stream.bytes(offset + kRecordPrefix, std::min(length, kLongestHead)),
                       length);
}

std::uint64_t find_chunk(RecordStream& stream, std::uint64_t offset) {
  std::vector<std::byte> window;
  while (offset < stream.end()) {
    // A copy: looking closer at a place moves the stream's own window.
    const Bytes bytes = stream.bytes(offset, std::min(kSearchWindow, stream.end() - offset));
    window.assign(bytes.begin(), bytes.end());
    for (std::size_t i = 0; i < window.size(); ++i) {
      const void* hit =
          std::memchr(&window[i], static_cast<int>(Opcode::kChunk), window.size() - i);
      if (hit == nullptr) break;
      i = static_cast<std::size_t>(static_cast<const std::byte*>(hit) - window.data());
      if (is_plausible_record(stream, offset + i)) return offset + i;
    }
    offset += window.size();
  }
  return stream.end();
}

}  // namespace coop::mcap
