#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.hpp"

namespace coop::capture {

/// What a writer offers, as rosbag2 keeps it with a topic (`offered_qos_profiles`): the numbers are
/// those of rmw's enumerations. History is not told by discovery: it is "unknown" in our captures.
struct OfferedQos {
  enum class History : std::uint8_t { kSystemDefault, kKeepLast, kKeepAll, kUnknown };
  enum class Liveliness : std::uint8_t { kAutomatic = 1, kManualByTopic = 3 };

  History history = History::kUnknown;
  int depth = 0;
  bool reliable = true;
  bool transient_local = false;
  Duration deadline = Duration::max();
  Duration lifespan = Duration::max();
  Liveliness liveliness = Liveliness::kAutomatic;
  Duration liveliness_lease = Duration::max();

  bool operator==(const OfferedQos&) const = default;
};

/// A YAML sequence of one profile.
[[nodiscard]] std::string to_yaml(const OfferedQos& qos);

/// The profiles of a channel's metadata; numbers as written by rosbag2 up to Humble or names as
/// written since. What is missing or not understood keeps its default.
[[nodiscard]] std::vector<OfferedQos> parse_offered_qos(std::string_view yaml);

}  // namespace coop::capture
