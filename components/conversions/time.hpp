#pragma once
#include <builtin_interfaces/msg/Duration.h>
#include <builtin_interfaces/msg/Time.h>
#include <rosgraph_msgs/msg/Clock.h>
#include <std_msgs/msg/Header.h>

#include <string>

#include "core/result.hpp"
#include "core/time.hpp"

namespace coop::conversions {

/// Exact within what the message can hold, -2^31 to 2^31 seconds from the epoch; beyond, the
/// nearest it can hold.
[[nodiscard]] builtin_interfaces::msg::Time to_msg(Time time);
[[nodiscard]] builtin_interfaces::msg::Duration to_msg(Duration duration);
/// Refused: a nanosecond field of a second or more.
[[nodiscard]] Result<Time> from_msg(const builtin_interfaces::msg::Time& message);
[[nodiscard]] Result<Duration> from_msg(const builtin_interfaces::msg::Duration& message);

[[nodiscard]] std_msgs::msg::Header to_header(Time stamp, const std::string& frame_id);

[[nodiscard]] rosgraph_msgs::msg::Clock to_clock_msg(Time time);
[[nodiscard]] Result<Time> from_msg(const rosgraph_msgs::msg::Clock& message);

}  // namespace coop::conversions
