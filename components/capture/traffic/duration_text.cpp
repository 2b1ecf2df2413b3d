#include "capture/traffic/duration_text.hpp"

#include <charconv>
#include <cmath>

namespace coop::capture {

std::optional<double> parse_duration(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value) || value < 0.0) return std::nullopt;
  const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (unit.empty() || unit == "s") return value;
  if (unit == "ms") return value / 1000.0;
  if (unit == "min") return value * 60.0;
  if (unit == "h") return value * 3600.0;
  return std::nullopt;
}

}  // namespace coop::capture
