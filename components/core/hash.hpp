#pragma once
#include <cstdint>
#include <string_view>

namespace coop {

/// FNV-1a, 64 bits: fingerprints and checksums that need not withstand an attacker.
class Fnv1a {
 public:
  constexpr void add(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001B3ULL; }
  constexpr void add(std::string_view bytes) {
    for (const char c : bytes) add(static_cast<std::uint8_t>(c));
  }
  /// As one step: not the same as its bytes one by one.
  constexpr void add_word(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001B3ULL; }
  [[nodiscard]] constexpr std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325ULL;
};

[[nodiscard]] constexpr std::uint64_t fnv1a(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.value();
}

}  // namespace coop
