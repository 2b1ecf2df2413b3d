#include "capture/mcap/crc.hpp"

#include <zlib.h>

namespace coop::mcap {

void Crc32::add(std::span<const std::byte> bytes) {
  // An empty span may have no address, which zlib takes for "begin anew".
  if (bytes.empty()) return;
  crc_ = static_cast<std::uint32_t>(
      crc32_z(crc_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace coop::mcap
