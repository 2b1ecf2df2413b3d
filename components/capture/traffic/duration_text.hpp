#pragma once
#include <optional>
#include <string_view>

namespace coop::capture {

/// Seconds of "90", "90s", "1.5min", "10min", "2h"; nothing for other texts.
[[nodiscard]] std::optional<double> parse_duration(std::string_view text);

}  // namespace coop::capture
