#pragma once
#include <cstdint>
#include <span>

namespace coop::mcap {

/// CRC-32 (IEEE 802.3, reflected, as zlib's) of the bytes so far.
class Crc32 {
 public:
  void add(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint32_t value() const { return crc_; }

 private:
  std::uint32_t crc_ = 0;
};

[[nodiscard]] inline std::uint32_t crc32_of(std::span<const std::byte> bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace coop::mcap
