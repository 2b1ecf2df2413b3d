#include "capture/schema/cdr_cursor.hpp"

#include <cmath>

namespace coop::capture {

std::string CdrError::text() const {
  return path + (path.empty() ? "at byte " : " at byte ") + std::to_string(offset) + ": " + reason;
}

std::int64_t Number::as_int64() const {
  switch (width_of(type)) {
    case 1:
      return static_cast<std::int8_t>(bits);
    case 2:
      return static_cast<std::int16_t>(bits);
    case 4:
      return static_cast<std::int32_t>(bits);
    default:
      return static_cast<std::int64_t>(bits);
  }
}

double Number::as_double() const {
  if (type == Primitive::kFloat32) return static_cast<double>(as_float32());
  if (type == Primitive::kFloat64) return as_float64();
  return is_signed() ? static_cast<double>(as_int64()) : static_cast<double>(bits);
}

bool is_same(const Number& a, const Number& b) {
  if (!a.is_float()) return a.bits == b.bits;
  const double x = a.as_double();
  const double y = b.as_double();
  return x == y || (std::isnan(x) && std::isnan(y));
}

CdrCursor::CdrCursor(std::span<const std::byte> payload) {
  if (payload.size() < kEncapsulation) {
    fail("no encapsulation: the payload has fewer than four bytes");
    return;
  }
  const auto first = static_cast<std::uint8_t>(payload[0]);
  const auto second = static_cast<std::uint8_t>(payload[1]);
  if (first != 0 || second > 1) {
    fail("an encapsulation other than plain CDR (XCDR1)");
    return;
  }
  body_ = payload.subspan(kEncapsulation);
  swap_ = (second == 1) != (std::endian::native == std::endian::little);
}

std::string_view CdrCursor::text(std::uint32_t bound) {
  const NumberArray length = numbers(Primitive::kUint32, 1);
  if (failed()) return {};
  const std::uint64_t size = length[0].bits;
  if (size > remaining()) {
    fail("a string that is longer than the payload");
    return {};
  }
  std::string_view result(reinterpret_cast<const char*>(body_.data() + at_), size);
  // Some writers count the terminating zero out, or leave it away where the string is empty.
  if (result.ends_with('\0')) result.remove_suffix(1);
  if (bound > 0 && result.size() > bound) {
    fail("a string that is longer than its bound");
    return {};
  }
  at_ += size;
  return result;
}

std::size_t CdrCursor::length(std::uint32_t bound, std::uint64_t least_element_size) {
  const NumberArray length = numbers(Primitive::kUint32, 1);
  if (failed()) return 0;
  const std::uint64_t count = length[0].bits;
  if (bound > 0 && count > bound) {
    fail("a sequence that is longer than its bound");
    return 0;
  }
  if (count > remaining() / least_element_size) {
    fail("a sequence that is longer than the payload");
    return 0;
  }
  return count;
}

void CdrCursor::skip(std::uint64_t bytes) {
  if (failed()) return;
  if (bytes > remaining()) return fail("the payload ends");
  at_ += bytes;
}

void CdrCursor::skip(const TypeLayout& fixed, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count && !failed(); ++i) skip(fixed.advance[at_ % 8]);
}

}  // namespace coop::capture
