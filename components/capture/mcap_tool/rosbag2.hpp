#pragma once
#include <functional>
#include <optional>

#include "capture/mcap/writer.hpp"

namespace coop::mcap {

/// The text of a type's definition ("sensor_msgs/msg/LaserScan") with all it depends on, in the
/// schema encoding "ros2msg"; nothing for a type that is not known.
using DefinitionOf = std::function<std::optional<std::string>(std::string_view type)>;

struct ImportReport {
  std::uint64_t messages = 0;
  /// Types without a definition: their channels have a schema without text.
  std::vector<std::string> unknown_types;
};

/// A recording of rosbag2 in its sqlite3 format: the folder (with its parts *.db3 in the order of
/// their names) or one such file. Payloads are copied as they are, time stamps become log and
/// publish time, offered_qos_profiles the channels' metadata. Throws std::runtime_error naming the
/// file where it is none, or is damaged.
[[nodiscard]] ImportReport import_rosbag2(const std::filesystem::path& bag,
                                          const DefinitionOf& definition_of, Writer& writer);

}  // namespace coop::mcap
