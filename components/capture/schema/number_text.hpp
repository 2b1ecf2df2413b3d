#pragma once
#include <string>
#include <string_view>

#include "capture/schema/cdr_cursor.hpp"

namespace coop::capture {

/// Where a number stands: formats differ in how they write floating point and what is no number.
enum class TextStyle : std::uint8_t {
  kPlain,  ///< 1, nan, inf
  kYaml,   ///< 1.0, .nan, .inf
  kJson,   ///< 1.0, "NaN", "Infinity"
};

/// Shortest text that reads back as the same value of the same type.
void append_number(std::string& out, const Number& value, TextStyle style);

/// In quotes, escaped; bytes that are no UTF-8 become U+FFFD.
void append_json_string(std::string& out, std::string_view text);

/// As a plain scalar where YAML reads that as the same string, else in quotes.
void append_yaml_string(std::string& out, std::string_view text);

}  // namespace coop::capture
