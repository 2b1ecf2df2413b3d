#pragma once
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace coop::test {

/// Plain CDR put together by hand, in either byte order.
class CdrBytes {
 public:
  explicit CdrBytes(bool little_endian = true) : little_(little_endian) {
    const auto order = little_ ? std::byte{1} : std::byte{0};
    bytes_ = {std::byte{0}, order, std::byte{0}, std::byte{0}};
  }

  template <class T>
  CdrBytes& put(T value) {
    while ((bytes_.size() - 4) % sizeof(T) != 0) bytes_.push_back(std::byte{0});
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    const bool as_is = little_ == (std::endian::native == std::endian::little);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(as_is ? raw[i] : raw[sizeof(T) - 1 - i]);
    }
    return *this;
  }
  CdrBytes& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    for (const char c : value) put(c);
    return put('\0');
  }
  CdrBytes& length(std::uint32_t count) { return put(count); }

  operator std::span<const std::byte>() const { return bytes_; }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  bool little_;
  std::vector<std::byte> bytes_;
};

}  // namespace coop::test
