#pragma once
#include <span>
#include <string>
#include <string_view>

#include "runtime/qos.hpp"

namespace coop::runtime {

/// One topic of the system: the contract between those who write it and those who read it.
/// docs/interfaces.md is generated from this table, and a test holds every advertise() and
/// subscribe() of the components against it.
struct TopicInfo {
  std::string_view name;  ///< as in Node::advertise; `rt/<name>` on the wire
  std::string_view type;  ///< "sensor_msgs/LaserScan"
  Qos qos = Qos::kEvent;
  double rate = 0.0;         ///< Hz; 0: when there is something to say
  std::string_view writers;  ///< programs, separated by ", "; "person": a command of `coop`; "all":
                             ///< every component
  std::string_view readers;  ///< likewise
  std::string_view about;    ///< one line
};

/// In alphabetical order of names.
[[nodiscard]] std::span<const TopicInfo> all_topics();

/// Nothing where no topic of the system has that name.
[[nodiscard]] const TopicInfo* find_topic(std::string_view name);

/// "sensor_msgs/LaserScan" -> "sensor_msgs::msg::dds_::LaserScan_".
[[nodiscard]] std::string dds_type_name(std::string_view type);

/// Whether the program is named in a list of writers or readers.
[[nodiscard]] bool lists(std::string_view programs, std::string_view program);

}  // namespace coop::runtime
