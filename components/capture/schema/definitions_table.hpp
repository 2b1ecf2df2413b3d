#pragma once
#include <span>
#include <string_view>

namespace coop::capture {

struct KnownDefinition {
  std::string_view name;  ///< "sensor_msgs/msg/LaserScan"
  std::string_view text;
};

/// Ordered by "package/Type". The build writes it from the IDL folder; definitions.hpp is what
/// looks into it.
[[nodiscard]] std::span<const KnownDefinition> definitions_table();

}  // namespace coop::capture
