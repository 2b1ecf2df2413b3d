#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace coop::capture {

/// Topic names as people and ROS 2's tools know them: "/scan" of "rt/scan" on the wire. A name that
/// does not follow that rule stays as it is, without a slash before it, both ways.
[[nodiscard]] std::string shown_topic(std::string_view wire_name);
[[nodiscard]] std::string wire_topic(std::string_view shown_name);

/// "sensor_msgs/msg/LaserScan" of "sensor_msgs::msg::dds_::LaserScan_", and back; other names stay.
[[nodiscard]] std::string shown_type(std::string_view dds_type);
[[nodiscard]] std::string dds_type(std::string_view shown_type);

/// A pattern for topic names: a glob (`*` any text, also with slashes, `?` one character) over the
/// whole name, or, behind `re:`, a regular expression (ECMAScript) over the whole name. The slash
/// at the begin may be left out.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view shown_name);

/// Which topics are wanted: those of any `topics` pattern (none: all), but of no `exclude` pattern.
struct TopicSelection {
  std::vector<std::string> topics{};
  std::vector<std::string> exclude{};

  [[nodiscard]] bool wants(std::string_view shown_name) const;
  /// Throws std::invalid_argument naming a pattern that is none.
  void validate() const;
};

}  // namespace coop::capture
