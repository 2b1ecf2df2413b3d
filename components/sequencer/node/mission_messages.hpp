#pragma once
#include "coop_msgs/msg/MissionStatus.h"
#include "coop_msgs/msg/NavigationStatus.h"
#include "coop_msgs/msg/PickResult.h"
#include "sequencer/sequencer.hpp"

namespace coop::sequencer {

[[nodiscard]] coop_msgs::msg::MissionStatus to_msg(const MissionState& state,
                                                   const EggTracks& tracks, Time now);

/// Nothing while the drive is under way or the message is about another goal. Only dwa tells of an
/// arrival; both navigators may fail. A goal taken back has failed too.
[[nodiscard]] std::optional<NavigationReport> to_report(
    const coop_msgs::msg::NavigationStatus& status);

[[nodiscard]] PickReport to_report(const coop_msgs::msg::PickResult& result);

}  // namespace coop::sequencer
