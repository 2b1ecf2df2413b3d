#pragma once
#include "capture/mcap/record_stream.hpp"

namespace coop::mcap {

/// Whether the bytes at `offset` can be a record: a known opcode, a length within the file and,
/// for a chunk, a head that agrees with it.
[[nodiscard]] bool is_plausible_record(RecordStream& stream, std::uint64_t offset);

/// The first place from `offset` on that looks like a Chunk (which has much to check: length,
/// compression, sizes, times), or the stream's end.
[[nodiscard]] std::uint64_t find_chunk(RecordStream& stream, std::uint64_t offset);

}  // namespace coop::mcap
