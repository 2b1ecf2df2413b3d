#pragma once
#include <bit>
#include <cstring>
#include <string>

#include "capture/schema/message_layout.hpp"
#include "core/result.hpp"

namespace coop::capture {

/// Why a payload is no message of its type.
struct CdrError {
  std::size_t offset = 0;  ///< from the start of the payload, encapsulation included
  std::string path;        ///< field in which it shows, "transforms[3].header"; empty: the whole
  std::string reason;

  /// "transforms[3].header at byte 52: string beyond the end"
  [[nodiscard]] std::string text() const;
};

/// One number of a payload, in the machine's byte order.
struct Number {
  Primitive type = Primitive::kUint8;
  std::uint64_t bits = 0;

  [[nodiscard]] bool is_float() const {
    return type == Primitive::kFloat32 || type == Primitive::kFloat64;
  }
  [[nodiscard]] bool is_signed() const {
    return type == Primitive::kInt8 || type == Primitive::kInt16 || type == Primitive::kInt32 ||
           type == Primitive::kInt64;
  }
  [[nodiscard]] float as_float32() const {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  }
  [[nodiscard]] double as_float64() const { return std::bit_cast<double>(bits); }
  /// Of an integer that is_signed().
  [[nodiscard]] std::int64_t as_int64() const;
  [[nodiscard]] double as_double() const;
};

/// The same value: NaN is equal to NaN, 0 to -0.
[[nodiscard]] bool is_same(const Number& a, const Number& b);

/// Numbers that lie one behind the other in a payload, read where they are.
class NumberArray {
 public:
  NumberArray(Primitive type, const std::byte* data, std::size_t count, bool swap)
      : data_(data), count_(count), width_(width_of(type)), type_(type), swap_(swap) {}

  [[nodiscard]] Primitive type() const { return type_; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] Number operator[](std::size_t i) const;
  [[nodiscard]] std::span<const std::byte> bytes() const { return {data_, count_ * width_}; }
  [[nodiscard]] bool is_swapped() const { return swap_; }

 private:
  const std::byte* data_;
  std::size_t count_;
  std::size_t width_;
  Primitive type_;
  bool swap_;
};

/// Reads plain CDR (XCDR1, either byte order) behind its four bytes of encapsulation. Every read is
/// checked against the end; after a failed one the cursor stands still and all others fail.
class CdrCursor {
 public:
  explicit CdrCursor(std::span<const std::byte> payload);

  [[nodiscard]] bool failed() const { return reason_ != nullptr; }
  /// Why, and where; call it after a failure.
  [[nodiscard]] CdrError error() const { return {offset(), {}, reason_}; }
  /// From the start of the payload.
  [[nodiscard]] std::size_t offset() const {
    return at_ + (body_.data() == nullptr ? 0 : kEncapsulation);
  }
  [[nodiscard]] std::size_t remaining() const { return body_.size() - at_; }

  Number number(Primitive type) {
    const NumberArray one = numbers(type, 1);
    return one.size() == 1 ? one[0] : Number{type, 0};
  }
  /// All of them or, after a failure, none.
  NumberArray numbers(Primitive type, std::uint64_t count);
  /// The characters without the terminating zero; valid as long as the payload is.
  std::string_view text(std::uint32_t bound);
  /// Length of a sequence whose elements have at least that many bytes each. So an absurd length is
  /// refused before anybody loops over it.
  std::size_t length(std::uint32_t bound, std::uint64_t least_element_size);
  /// Beyond a message of a fixed type.
  void skip(const TypeLayout& fixed, std::uint64_t count);
  /// Beyond so many bytes.
  void skip(std::uint64_t bytes);
  void fail(const char* reason) {
    if (reason_ == nullptr) reason_ = reason;
  }

  static constexpr std::size_t kEncapsulation = 4;

 private:
  bool align(std::size_t width);

  std::span<const std::byte> body_;
  std::size_t at_ = 0;
  bool swap_ = false;
  const char* reason_ = nullptr;
};

// --------------------------------------------------------------------------------- inline: hot

inline Number NumberArray::operator[](std::size_t i) const {
  const std::byte* at = data_ + i * width_;
  switch (width_) {
    case 1:
      return {type_, static_cast<std::uint8_t>(*at)};
    case 2: {
      std::uint16_t bits = 0;
      std::memcpy(&bits, at, 2);
      return {type_, swap_ ? __builtin_bswap16(bits) : bits};
    }
    case 4: {
      std::uint32_t bits = 0;
      std::memcpy(&bits, at, 4);
      return {type_, swap_ ? __builtin_bswap32(bits) : bits};
    }
    default: {
      std::uint64_t bits = 0;
      std::memcpy(&bits, at, 8);
      return {type_, swap_ ? __builtin_bswap64(bits) : bits};
    }
  }
}

inline bool CdrCursor::align(std::size_t width) {
  if (failed()) return false;
  const std::size_t aligned = (at_ + width - 1) & ~(width - 1);
  if (aligned > body_.size()) {
    fail("the payload ends");
    return false;
  }
  at_ = aligned;
  return true;
}

inline NumberArray CdrCursor::numbers(Primitive type, std::uint64_t count) {
  const NumberArray none(type, nullptr, 0, false);
  const std::size_t width = width_of(type);
  if (count == 0 || !align(width)) return none;
  if (count > remaining() / width) {
    fail("the payload ends");
    return none;
  }
  const NumberArray result(type, body_.data() + at_, count, swap_);
  if (type == Primitive::kBool) {
    for (const std::byte byte : result.bytes()) {
      if (static_cast<std::uint8_t>(byte) > 1) {
        fail("a bool that is neither 0 nor 1");
        return none;
      }
    }
  }
  at_ += count * width;
  return result;
}

}  // namespace coop::capture
