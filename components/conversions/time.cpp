#include "conversions/time.hpp"

#include <limits>

namespace coop::conversions {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

template <class Message>
Message split(std::int64_t nanoseconds) {
  // Rounds down, so that the nanosecond part is never negative.
  std::int64_t seconds = nanoseconds / kSecond;
  if (nanoseconds % kSecond < 0) --seconds;
  std::int64_t rest = nanoseconds - seconds * kSecond;
  using Seconds = std::numeric_limits<std::int32_t>;
  if (seconds < Seconds::min()) {
    seconds = Seconds::min();
    rest = 0;
  } else if (seconds > Seconds::max()) {
    seconds = Seconds::max();
    rest = kSecond - 1;
  }
  Message message;
  message.sec(static_cast<std::int32_t>(seconds));
  message.nanosec(static_cast<std::uint32_t>(rest));
  return message;
}

template <class Message>
Result<Duration> join(const Message& message) {
  if (message.nanosec() >= kSecond) return fail("nanoseconds amount to a second or more");
  return Duration(message.sec() * kSecond + message.nanosec());
}

}  // namespace

builtin_interfaces::msg::Time to_msg(Time time) {
  return split<builtin_interfaces::msg::Time>(to_nanoseconds(time));
}

builtin_interfaces::msg::Duration to_msg(Duration duration) {
  return split<builtin_interfaces::msg::Duration>(duration.count());
}

Result<Time> from_msg(const builtin_interfaces::msg::Time& message) {
  return join(message).map([](Duration since_epoch) { return Time(since_epoch); });
}

Result<Duration> from_msg(const builtin_interfaces::msg::Duration& message) {
  return join(message);
}

std_msgs::msg::Header to_header(Time stamp, const std::string& frame_id) {
  std_msgs::msg::Header header;
  header.stamp(to_msg(stamp));
  header.frame_id(frame_id);
  return header;
}

rosgraph_msgs::msg::Clock to_clock_msg(Time time) {
  rosgraph_msgs::msg::Clock message;
  message.clock(to_msg(time));
  return message;
}

Result<Time> from_msg(const rosgraph_msgs::msg::Clock& message) {
  return from_msg(message.clock());
}

}  // namespace coop::conversions
