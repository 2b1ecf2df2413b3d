#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coop::capture {

/// Definition text (schema encoding `ros2msg`) of a type of ours with all it depends on, made from
/// the IDL folder when Coop is built. `name` is "sensor_msgs/msg/LaserScan" or
/// "sensor_msgs/LaserScan".
[[nodiscard]] std::optional<std::string_view> ros2msg_definition(std::string_view name);

/// Names of all of them, "sensor_msgs/msg/LaserScan", in order.
[[nodiscard]] std::vector<std::string_view> ros2msg_names();

/// "sensor_msgs/msg/LaserScan" of the type's name on the wire,
/// "sensor_msgs::msg::dds_::LaserScan_"; nothing for a name that does not follow ROS 2's rule.
[[nodiscard]] std::optional<std::string> ros2_type_of_dds(std::string_view dds_name);

}  // namespace coop::capture
