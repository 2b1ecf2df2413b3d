#pragma once
#include <string_view>
#include <vector>

#include "sequencer/mission.hpp"

namespace coop::sequencer {

/// What a kind of mission does its own way; everything else (tours, order, drives, retries, the
/// journal) is the same for all.
struct MissionRules {
  std::string_view target;  ///< what it is after, empty: nothing
  std::string_view done;    ///< what becomes of one
  /// At every step, before the phase's own work.
  void (Mission::*observe)(const MissionSnapshot&);
  /// Whether the tour of the waypoints may end before its last one.
  bool (Mission::*knows_enough)() const;
  /// After the tour.
  void (Mission::*after_search)(const MissionSnapshot&);
  /// Targets that come after all others.
  bool (*is_put_off)(const EggTask&);
  /// Whether to wait a while before those are tried.
  bool (Mission::*waits)(const std::vector<const EggTask*>& put_off, Time);
  /// On the way to a target: true where that has ended the approach.
  bool (Mission::*on_the_way)(const MissionSnapshot&, EggTask&);
  /// At the end of the drive to a target.
  void (Mission::*at_target)(const MissionSnapshot&, Time);
  /// No target is left.
  void (Mission::*nothing_left)(Time);
  /// Back home.
  void (Mission::*at_home)();
};

}  // namespace coop::sequencer
