#pragma once
#include <string_view>

namespace coop::runtime {

/// Quality of service by intent: what the data means, not how it travels. The policies of each
/// stand in one place, dds_qos.cpp; docs/interfaces.md is generated from them.
///  - kSensorStream: only the newest matters, a lost sample is replaced by the next.
///  - kStateLatched: the last word of every writer (and key), also for who comes late.
///  - kCommand: the newest order must arrive, in time.
///  - kEvent: every one must arrive, in order.
///  - kHeartbeat: a latched state whose silence is noticed.
enum class Qos { kSensorStream, kStateLatched, kCommand, kEvent, kHeartbeat };

[[nodiscard]] constexpr std::string_view to_string(Qos qos) {
  switch (qos) {
    case Qos::kSensorStream:
      return "sensor_stream";
    case Qos::kStateLatched:
      return "state_latched";
    case Qos::kCommand:
      return "command";
    case Qos::kEvent:
      return "event";
    case Qos::kHeartbeat:
      return "heartbeat";
  }
  return "";
}

}  // namespace coop::runtime
