#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"

namespace coop::sequencer {

enum class MissionKind : std::uint8_t { kCollect, kSurvey, kClean };
enum class MissionPhase : std::uint8_t {
  kIdle,
  kSearching,
  kOrdering,
  kDriving,
  kPicking,
  kReturning,
  kDone,
  kFailed,
  kPaused
};
/// Numbers as in coop_msgs/EggStatus.
enum class EggPhase : std::uint8_t {
  kSeen,
  kQueued,
  kApproaching,
  kPicking,
  kPicked,
  kFailed,
  kMissing
};

[[nodiscard]] std::string_view to_string(MissionPhase phase);

struct Waypoint {
  std::string name;
  Pose2 pose_in_map;
};

/// One egg of the mission and all that was tried for it.
struct EggTask {
  std::string id;
  Eigen::Vector2d egg_in_map{0, 0};
  EggPhase phase = EggPhase::kSeen;
  int attempts = 0;  ///< approaches begun
  int unseen = 0;    ///< of these, on which it was not to be seen, since last seen
  std::vector<double> tried_headings;  ///< rad, of approaches that came to nothing
  std::string reason;                  ///< of the last failure
};

/// All a mission must not forget: what the journal holds, one line a change.
struct MissionState {
  std::string mission_id;
  MissionKind kind = MissionKind::kCollect;
  MissionPhase phase = MissionPhase::kIdle;
  MissionPhase resume_phase = MissionPhase::kIdle;  ///< where a pause goes back to
  std::string detail;
  std::vector<Waypoint> waypoints;
  std::size_t next_waypoint = 0;
  int searches = 0;                           ///< tours of the waypoints ended
  std::vector<std::string> missed_waypoints;  ///< names, with the reason
  std::vector<EggTask> eggs;
  std::vector<std::string> order;  ///< ids of eggs, as ordered last
  double tour_cost = 0.0;
  double tour_cost_alternative = 0.0;  ///< by the method not chosen
  std::string current_egg;             ///< empty: none
  std::string pick_id;                 ///< of the pick under way, empty: none
  std::string goal_id;                 ///< told to the navigators and not at its end, empty: none
  bool has_home = false;
  Pose2 home_in_map;  ///< where the mission began

  /// Looked for from the egg of index `first` on, round to the one before it.
  [[nodiscard]] EggTask* find_egg(std::string_view id, std::size_t first = 0);
  [[nodiscard]] const EggTask* find_egg(std::string_view id) const;
  [[nodiscard]] int count(EggPhase phase) const;
  [[nodiscard]] bool is_active() const;  ///< neither idle nor at its end
};

}  // namespace coop::sequencer
