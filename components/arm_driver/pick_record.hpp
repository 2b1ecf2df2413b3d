#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace coop::arm_driver {

/// Numbers as in coop_msgs/PickResult.
enum class PickOutcome : std::uint8_t {
  kPicked = 0,
  kOutOfReach = 1,
  kNoVacuum = 2,
  kJointLimit = 3,
  kAborted = 4,
  kBusy = 5,
};
[[nodiscard]] std::string_view to_string(PickOutcome outcome);

/// How a pick ended.
struct PickReport {
  std::string pick_id;
  std::string egg_id;
  PickOutcome outcome = PickOutcome::kPicked;
  std::string detail;  ///< for people
  bool operator==(const PickReport&) const = default;
};

/// What a later life of the driver must know of the running pick.
enum class PickStage : std::uint8_t {
  kStarted,    ///< the egg lies where it lay
  kHolding,    ///< the egg hangs on the cup
  kReleasing,  ///< over the basket: what hangs or hung on the cup falls into it
};

struct RunningPick {
  std::string pick_id;  ///< empty: an egg was found on the cup and nobody knows why
  std::string egg_id;
  PickStage stage = PickStage::kStarted;
  bool operator==(const RunningPick&) const = default;
};

/// The driver's memory: the running pick and the last results, so that an order said again is
/// answered and not carried out again.
struct PickRecord {
  static constexpr std::size_t kMaxResults = 64;

  std::optional<RunningPick> running;
  std::deque<PickReport> results;  ///< oldest first

  [[nodiscard]] const PickReport* find(std::string_view pick_id) const;
  void add(PickReport report);
  bool operator==(const PickRecord&) const = default;
};

/// As JSON, and back; an error says why the text is no record.
[[nodiscard]] std::string to_text(const PickRecord& record);
[[nodiscard]] Result<PickRecord> parse_pick_record(std::string_view text);

}  // namespace coop::arm_driver
