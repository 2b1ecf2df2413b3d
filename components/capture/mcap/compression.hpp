#pragma once
#include <memory>
#include <string_view>

#include "capture/mcap/encode.hpp"

namespace coop::mcap {

enum class Compression { kNone, kLz4, kZstd };

/// As chunks name it: "", "lz4", "zstd".
[[nodiscard]] std::string_view name_of(Compression compression);
/// Throws std::invalid_argument naming those there are.
[[nodiscard]] Compression compression_named(std::string_view name);

/// Compresses chunks, one context for all of them. `level`: of zstd (1 fast ... 19 small) or of
/// lz4 (0 fast, 3 ... 12 small). Not for two threads at a time.
class Compressor {
 public:
  Compressor(Compression compression, int level);
  ~Compressor();
  Compressor(Compressor&&) noexcept;
  Compressor& operator=(Compressor&&) noexcept;

  [[nodiscard]] Compression compression() const { return compression_; }
  /// A view of `records` itself where nothing is to be compressed, else of `out`.
  [[nodiscard]] Bytes compress(Bytes records, ByteBuffer& out);

 private:
  struct Contexts;
  Compression compression_;
  int level_;
  std::unique_ptr<Contexts> contexts_;
};

/// Uncompresses chunks. Not for two threads at a time.
class Decompressor {
 public:
  Decompressor();
  ~Decompressor();
  Decompressor(Decompressor&&) noexcept;
  Decompressor& operator=(Decompressor&&) noexcept;

  /// Into `out` (replaced; memory grows with what really comes out, never with what the chunk
  /// promises) and checks size and CRC. Throws FileError at `offset` for an unknown compression, a
  /// size beyond `max_size`, data that is damaged or does not have the size or CRC promised.
  void decompress(const Chunk& chunk, std::uint64_t offset, std::uint64_t max_size,
                  std::vector<std::byte>& out);
  /// What comes out before the data ends or turns out to be damaged: for chunks cut off. Not
  /// checked against the CRC, and at most the promised size or `max_size`.
  void decompress_prefix(const Chunk& chunk, std::uint64_t max_size, std::vector<std::byte>& out);

 private:
  struct Contexts;
  /// True if the compressed data came to its proper end.
  bool stream(std::string_view compression, Bytes in, std::uint64_t limit,
              std::vector<std::byte>& out);
  std::unique_ptr<Contexts> contexts_;
};

}  // namespace coop::mcap
