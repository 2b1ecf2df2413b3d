#include "capture/schema/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace coop::capture {
namespace {

constexpr std::array<std::string_view, 3> kNan{"nan", ".nan", "\"NaN\""};
constexpr std::array<std::string_view, 3> kInfinity{"inf", ".inf", "\"Infinity\""};
constexpr std::array<std::string_view, 3> kMinusInfinity{"-inf", "-.inf", "\"-Infinity\""};

template <class T>
void append_float(std::string& out, T value, TextStyle style) {
  const auto place = static_cast<std::size_t>(style);
  if (std::isnan(value)) {
    out += kNan[place];
    return;
  }
  if (std::isinf(value)) {
    out += value > 0 ? kInfinity[place] : kMinusInfinity[place];
    return;
  }
  std::array<char, 40> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  if (style == TextStyle::kPlain || text.find('.') != std::string_view::npos) {
    out += text;
    return;
  }
  // YAML takes a number for floating point by its point.
  const auto exponent = std::min(text.find('e'), text.size());
  out += text.substr(0, exponent);
  out += ".0";
  out += text.substr(exponent);
}

/// Length of the UTF-8 sequence at the start of the text; 0: there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  }
  // Overlong forms, surrogates, and what is beyond U+10FFFF.
  const std::uint8_t second = byte(1);
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
      (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) {
    return 0;
  }
  return length;
}

void append_escaped(std::string& out, char c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  switch (c) {
    case '"':
    case '\\':
      out += '\\';
      out += c;
      return;
    case '\n':
      out += "\\n";
      return;
    case '\t':
      out += "\\t";
      return;
    case '\r':
      out += "\\r";
      return;
    default:
      break;
  }
  const auto byte = static_cast<std::uint8_t>(c);
  if (byte >= 0x20 && byte != 0x7F) {
    out += c;
    return;
  }
  out += "\\u00";
  out += kHex[byte >> 4U];
  out += kHex[byte & 0xFU];
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '/';
}

/// Text that every YAML reader takes for a string as it stands.
bool is_plain_yaml(std::string_view text) {
  if (text.empty() || !is_letter(text.front()) || text.back() == ' ') return false;
  if (!std::ranges::all_of(text, [](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == ' ';
      })) {
    return false;
  }
  static constexpr std::array<std::string_view, 9> kWords{"null", "true", "false", "yes", "no",
                                                          "on",   "off",  "y",     "n"};
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return std::ranges::find(kWords, lower) == kWords.end();
}

bool is_printable(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= 0x20 && c < 0x7F; });
}

}  // namespace

void append_number(std::string& out, const Number& value, TextStyle style) {
  if (value.type == Primitive::kFloat64) return append_float(out, value.as_float64(), style);
  if (value.type == Primitive::kFloat32) return append_float(out, value.as_float32(), style);
  if (value.type == Primitive::kBool) {
    out += value.bits != 0 ? "true" : "false";
    return;
  }
  std::array<char, 24> buffer;
  char* const last = buffer.data() + buffer.size();
  const char* const end = value.is_signed()
                              ? std::to_chars(buffer.data(), last, value.as_int64()).ptr
                              : std::to_chars(buffer.data(), last, value.bits).ptr;
  out.append(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) {
      out += "\xEF\xBF\xBD";
    } else if (length == 1) {
      append_escaped(out, text.front());
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  out += '"';
}

void append_yaml_string(std::string& out, std::string_view text) {
  if (is_plain_yaml(text)) {
    out += text;
    return;
  }
  // In double quotes YAML has all escapes of JSON.
  if (!is_printable(text)) return append_json_string(out, text);
  out += '\'';
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += c;
  }
  out += '\'';
}

}  // namespace coop::capture
