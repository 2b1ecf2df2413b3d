#pragma once
#include <optional>
#include <string>

#include "capture/schema/cdr_cursor.hpp"

namespace coop::capture {

/// Where two messages of a type first differ, with the values there as text.
struct PayloadDifference {
  std::string path;  ///< "ranges[17]"; "ranges" where the numbers of elements differ
  std::string first;
  std::string second;
};

/// Compares by value: byte order and padding do not count, NaN is equal to NaN, 0 to -0. Equal
/// bytes are not looked into. Of two payloads that differ, a malformed one is an error, whose
/// reason says which of the two.
[[nodiscard]] Result<std::optional<PayloadDifference>, CdrError> first_difference(
    const MessageLayout& layout, std::span<const std::byte> first,
    std::span<const std::byte> second);

}  // namespace coop::capture
