#pragma once
#include <limits>
#include <string>

#include "capture/schema/cdr_cursor.hpp"

namespace coop::capture {

struct TextOptions {
  /// Arrays longer than this are cut, with "..." as their last element.
  std::size_t max_elements = std::numeric_limits<std::size_t>::max();
  /// Levels by which YAML is moved to the right.
  std::size_t indent = 0;
};

/// The message as YAML, as people know it from ROS 2's `topic echo`: two spaces a level, elements
/// behind dashes, no document marker. After an error `out` ends with what was read up to there.
[[nodiscard]] Result<void, CdrError> append_yaml(const MessageLayout& layout,
                                                 std::span<const std::byte> payload,
                                                 const TextOptions& options, std::string& out);

/// The message as one JSON object on one line. What JSON has no number for is a string: "NaN",
/// "Infinity", "-Infinity". 64-bit integers are numbers with all their digits. After an error `out`
/// is as it was.
[[nodiscard]] Result<void, CdrError> append_json(const MessageLayout& layout,
                                                 std::span<const std::byte> payload,
                                                 const TextOptions& options, std::string& out);

}  // namespace coop::capture
