#include "capture/mcap/compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "capture/mcap/crc.hpp"
#include "capture/mcap/file_error.hpp"

namespace coop::mcap {
namespace {

template <auto free_function>
struct Free {
  template <class T>
  void operator()(T* context) const {
    free_function(context);
  }
};

/// One byte beyond the limit is made room for, so that "more than promised" is seen.
constexpr std::size_t kFirstStep = std::size_t{1} << 18U;

void grow(std::vector<std::byte>& out, std::uint64_t limit, std::size_t input) {
  const std::uint64_t first = std::max<std::uint64_t>(kFirstStep, 8 * std::uint64_t{input});
  const std::uint64_t wanted = out.empty() ? first : 2 * std::uint64_t{out.size()};
  out.resize(static_cast<std::size_t>(std::min(limit + 1, wanted)));
}

}  // namespace

std::string_view name_of(Compression compression) {
  switch (compression) {
    case Compression::kLz4:
      return "lz4";
    case Compression::kZstd:
      return "zstd";
    case Compression::kNone:
      break;
  }
  return "";
}

Compression compression_named(std::string_view name) {
  if (name.empty() || name == "none") return Compression::kNone;
  if (name == "lz4") return Compression::kLz4;
  if (name == "zstd") return Compression::kZstd;
  throw std::invalid_argument("no compression '" + std::string(name) + "': zstd, lz4 or none");
}

struct Compressor::Contexts {
  std::unique_ptr<ZSTD_CCtx, Free<ZSTD_freeCCtx>> zstd;
};

Compressor::Compressor(Compression compression, int level)
    : compression_(compression), level_(level), contexts_(std::make_unique<Contexts>()) {
  if (compression == Compression::kZstd) {
    contexts_->zstd.reset(ZSTD_createCCtx());
    if (!contexts_->zstd) throw std::bad_alloc();
  }
}
Compressor::~Compressor() = default;
Compressor::Compressor(Compressor&&) noexcept = default;
Compressor& Compressor::operator=(Compressor&&) noexcept = default;

Bytes Compressor::compress(Bytes records, ByteBuffer& out) {
  if (compression_ == Compression::kNone) return records;
  std::size_t size = 0;
  if (compression_ == Compression::kZstd) {
    const std::size_t bound = ZSTD_compressBound(records.size());
    if (out.size() < bound) out.resize(bound);
    size = ZSTD_compressCCtx(contexts_->zstd.get(), out.data(), out.size(), records.data(),
                             records.size(), level_);
    if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  } else {
    LZ4F_preferences_t preferences{};
    preferences.frameInfo.contentSize = records.size();
    preferences.compressionLevel = level_;
    const std::size_t bound = LZ4F_compressFrameBound(records.size(), &preferences);
    if (out.size() < bound) out.resize(bound);
    size = LZ4F_compressFrame(out.data(), out.size(), records.data(), records.size(), &preferences);
    if (LZ4F_isError(size) != 0) throw std::runtime_error(LZ4F_getErrorName(size));
  }
  return out.view().first(size);
}

/// Made when the first chunk needs them.
struct Decompressor::Contexts {
  std::unique_ptr<ZSTD_DCtx, Free<ZSTD_freeDCtx>> zstd;
  std::unique_ptr<LZ4F_dctx, Free<LZ4F_freeDecompressionContext>> lz4;

  void need(bool for_zstd) {
    if (for_zstd) {
      if (!zstd) zstd.reset(ZSTD_createDCtx());
      if (!zstd) throw std::bad_alloc();
    } else if (!lz4) {
      LZ4F_dctx* context = nullptr;
      if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) {
        throw std::bad_alloc();
      }
      lz4.reset(context);
    }
  }
};

Decompressor::Decompressor() : contexts_(std::make_unique<Contexts>()) {}
Decompressor::~Decompressor() = default;
Decompressor::Decompressor(Decompressor&&) noexcept = default;
Decompressor& Decompressor::operator=(Decompressor&&) noexcept = default;

bool Decompressor::stream(std::string_view compression, Bytes in, std::uint64_t limit,
                          std::vector<std::byte>& out) {
  const bool zstd = compression == "zstd";
  contexts_->need(zstd);
  if (zstd) {
    ZSTD_DCtx_reset(contexts_->zstd.get(), ZSTD_reset_session_only);
  } else {
    LZ4F_resetDecompressionContext(contexts_->lz4.get());
  }
  out.clear();
  std::size_t read = 0;
  std::size_t written = 0;
  bool ended = false;
  while (written <= limit) {
    if (written == out.size()) grow(out, limit, in.size());
    std::size_t consumed = in.size() - read;
    std::size_t produced = out.size() - written;
    std::size_t hint = 0;
    if (zstd) {
      ZSTD_inBuffer input{in.data() + read, consumed, 0};
      ZSTD_outBuffer output{out.data() + written, produced, 0};
      hint = ZSTD_decompressStream(contexts_->zstd.get(), &output, &input);
      consumed = input.pos;
      produced = output.pos;
      if (ZSTD_isError(hint) != 0) consumed = produced = 0;
    } else {
      hint = LZ4F_decompress(contexts_->lz4.get(), out.data() + written, &produced,
                             in.data() + read, &consumed, nullptr);
      // What came out of the blocks before the damaged one is good.
      if (LZ4F_isError(hint) != 0) consumed = produced = 0;
    }
    read += consumed;
    written += produced;
    if (hint == 0 && read == in.size()) {
      ended = true;
      break;
    }
    if (consumed == 0 && produced == 0) break;
  }
  out.resize(static_cast<std::size_t>(std::min<std::uint64_t>(written, limit + 1)));
  return ended;
}

void Decompressor::decompress(const Chunk& chunk, std::uint64_t offset, std::uint64_t max_size,
                              std::vector<std::byte>& out) {
  const auto fail = [&](const std::string& what) { throw FileError(offset, "Chunk: " + what); };
  if (chunk.uncompressed_size > max_size) {
    fail(std::to_string(chunk.uncompressed_size) + " bytes uncompressed; at most " +
         std::to_string(max_size) + " are read");
  }
  if (chunk.compression.empty()) {
    out.assign(chunk.records.begin(), chunk.records.end());
  } else if (chunk.compression != "zstd" && chunk.compression != "lz4") {
    fail("compression '" + chunk.compression + "' is unknown (zstd, lz4 or none)");
  } else if (chunk.records.empty() && chunk.uncompressed_size == 0) {
    out.clear();
  } else if (!stream(chunk.compression, chunk.records, chunk.uncompressed_size, out)) {
    fail("its " + chunk.compression + " data is damaged after " + std::to_string(out.size()) +
         " of " + std::to_string(chunk.uncompressed_size) + " bytes");
  }
  if (out.size() != chunk.uncompressed_size) {
    fail(std::to_string(out.size()) + " bytes uncompressed where it promises " +
         std::to_string(chunk.uncompressed_size));
  }
  if (chunk.uncompressed_crc != 0 && crc32_of(out) != chunk.uncompressed_crc) {
    fail("it has been damaged: its CRC differs");
  }
}

void Decompressor::decompress_prefix(const Chunk& chunk, std::uint64_t max_size,
                                     std::vector<std::byte>& out) {
  const std::uint64_t limit = std::min(chunk.uncompressed_size, max_size);
  if (chunk.compression.empty()) {
    out.assign(chunk.records.begin(), chunk.records.end());
  } else if (chunk.compression == "zstd" || chunk.compression == "lz4") {
    stream(chunk.compression, chunk.records, limit, out);
  } else {
    out.clear();
  }
  if (out.size() > limit) out.resize(static_cast<std::size_t>(limit));
}

}  // namespace coop::mcap
