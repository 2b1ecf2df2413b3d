#include "core/carmen/fields.hpp"

#include <charconv>
#include <cmath>

#include "core/carmen/carmen_log.hpp"

namespace coop::carmen {
namespace {

constexpr std::size_t kMaxValues = 100'000;
constexpr std::int64_t kMaxSeconds = 9'000'000'000;  // the year 2255; nanoseconds then fit 64 bits

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Digits, and digits after a point: exact to the nanosecond, where a double is not.
std::optional<Duration> parse_decimal_seconds(std::string_view text) {
  const auto dot = text.find('.');
  const std::string_view whole = text.substr(0, dot);
  const std::string_view fraction = dot == std::string_view::npos ? "" : text.substr(dot + 1);
  std::int64_t whole_seconds = 0;
  const auto [end, error] =
      std::from_chars(whole.data(), whole.data() + whole.size(), whole_seconds);
  const bool digits_only = fraction.find_first_not_of("0123456789") == std::string_view::npos;
  if (error != std::errc{} || end != whole.data() + whole.size() || whole_seconds < 0 ||
      whole_seconds > kMaxSeconds || !digits_only) {
    return std::nullopt;
  }
  std::int64_t nanoseconds = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    nanoseconds = nanoseconds * 10 + (i < fraction.size() ? fraction[i] - '0' : 0);
  }
  return Duration(whole_seconds * 1'000'000'000 + nanoseconds);
}

[[noreturn]] void reject(std::string_view what, std::string_view found) {
  throw FormatError(
      "expected " + std::string(what) +
      (found.empty() ? ", the line ends" : ", found '" + std::string(found.substr(0, 40)) + "'"));
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string_view FieldCursor::word(std::string_view what) {
  std::size_t start = 0;
  while (start < rest_.size() && is_blank(rest_[start])) ++start;
  std::size_t end = start;
  while (end < rest_.size() && !is_blank(rest_[end])) ++end;
  const std::string_view found = rest_.substr(start, end - start);
  if (found.empty()) reject(what, "");
  rest_.remove_prefix(end);
  return found;
}

double FieldCursor::number(std::string_view what) {
  const std::string_view found = word(what);
  const auto value = parse_number(found);
  if (!value || !std::isfinite(*value)) reject(std::string(what) + ", a number", found);
  return *value;
}

Pose2 FieldCursor::pose(std::string_view what) {
  const std::string name(what);
  Pose2 pose;
  pose.x = number("x of the " + name);
  pose.y = number("y of the " + name);
  pose.yaw = number("theta of the " + name);
  return pose;
}

Time FieldCursor::stamp(std::string_view what) {
  const std::string_view found = word(what);
  const auto exact = parse_decimal_seconds(found);
  if (exact) return Time(*exact);
  const auto rounded = parse_number(found);  // some loggers write 1.01893e+09, or nonsense
  if (!rounded || !(std::abs(*rounded) <= static_cast<double>(kMaxSeconds))) {
    reject(std::string(what) + " in seconds", found);
  }
  return time_from_seconds(*rounded);
}

std::vector<float> FieldCursor::values(std::string_view what) {
  const std::string name(what);
  const std::string_view found = word("the number of " + name);
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), count);
  if (error != std::errc{} || end != found.data() + found.size() || count > kMaxValues) {
    reject("the number of " + name, found);
  }
  std::vector<float> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view text = word(name);
    const auto value = parse_number(text);
    if (!value) reject(name + ", a number", text);
    values.push_back(static_cast<float>(*value));
  }
  return values;
}

void for_each_line(std::string_view text, const std::string& name,
                   const std::function<void(FieldCursor&)>& read) {
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    try {
      FieldCursor fields(line);
      read(fields);
    } catch (const FormatError& error) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": " + error.what());
    }
  }
}

}  // namespace coop::carmen
