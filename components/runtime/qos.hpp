#pragma once
#include <string_view>

namespace coop::runtime {

/// Quality of service by intent. What each means on the wire stands in one place, dds_qos.cpp:
/// | intent        | reliability | durability      | history            | further |
/// |---------------|-------------|-----------------|--------------------|--------------------------------------|
/// | kSensorStream | best effort | volatile        | last 5             | reliable, keep all with
/// --reliable-streams | | kStateLatched | reliable    | transient local | last 1 (a key)     | | |
/// kCommand      | reliable    | volatile        | last 1             | writer offers a deadline of
/// 200 ms   | | kEvent        | reliable    | volatile        | all, up to 2000    | | | kHeartbeat
/// | reliable    | transient local | last 1 (a key)     | liveliness manual by topic, lease 1 s |
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
