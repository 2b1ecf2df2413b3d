#include "sequencer/node/mission_messages.hpp"

#include <array>

#include "conversions/time.hpp"

namespace coop::sequencer {

using coop_msgs::msg::EggStatus;
using coop_msgs::msg::MissionStatus;
using coop_msgs::msg::NavigationStatus;
using coop_msgs::msg::PickResult;
namespace NavigationConstants = coop_msgs::msg::NavigationStatus_Constants;
namespace PickConstants = coop_msgs::msg::PickResult_Constants;

MissionStatus to_msg(const MissionState& state, const EggTracks& tracks, Time now) {
  MissionStatus message;
  message.header(conversions::to_header(now, "map"));
  message.mission_id(state.mission_id);
  message.kind(static_cast<std::uint8_t>(state.kind));
  message.state(static_cast<std::uint8_t>(state.phase));
  message.detail(state.detail);
  for (const EggTask& egg : state.eggs) {
    EggStatus status;
    status.egg_id(egg.id);
    status.state(static_cast<std::uint8_t>(egg.phase));
    status.attempts(static_cast<std::uint8_t>(egg.attempts));
    status.reason(egg.reason);
    status.position().x(egg.egg_in_map.x());
    status.position().y(egg.egg_in_map.y());
    if (const EggTrack* track = tracks.find(egg.id)) status.position_stddev(track->stddev());
    message.eggs().push_back(status);
  }
  message.order(state.order);
  message.current_egg(state.current_egg);
  message.tour_cost(state.tour_cost);
  message.tour_method_cost_alternative(state.tour_cost_alternative);
  return message;
}

namespace {

std::string reason_of(const NavigationStatus& status) {
  static constexpr std::array<std::string_view, 12> kNames{
      "no reason given", "no map",         "no pose",   "start blocked",
      "goal blocked",    "goal outside",   "no path",   "stuck",
      "sensor stale",    "emergency stop", "cancelled", "goal in unknown space"};
  std::string text(status.reason() < kNames.size() ? kNames.at(status.reason()) : "unknown reason");
  if (!status.detail().empty()) text += ": " + status.detail();
  return status.source() + ": " + text;
}

}  // namespace

std::optional<NavigationReport> to_report(const NavigationStatus& status) {
  NavigationReport report;
  report.goal_id = status.goal_id();
  if (status.state() == NavigationConstants::ARRIVED && status.source() == "dwa") {
    report.state = NavigationReport::State::kArrived;
    return report;
  }
  if (status.state() == NavigationConstants::FAILED ||
      status.state() == NavigationConstants::PREEMPTED) {
    report.state = NavigationReport::State::kFailed;
    report.reason = reason_of(status);
    return report;
  }
  return std::nullopt;
}

PickReport to_report(const PickResult& result) {
  static constexpr std::array<std::string_view, 6> kNames{
      "picked", "out of reach", "no vacuum", "joint limit", "aborted", "busy"};
  PickReport report;
  report.pick_id = result.pick_id();
  report.picked = result.result() == PickConstants::PICKED;
  report.is_final = result.result() != PickConstants::BUSY;
  report.reason = result.result() < kNames.size() ? kNames.at(result.result()) : "unknown";
  if (!result.detail().empty()) report.reason += ": " + result.detail();
  return report;
}

}  // namespace coop::sequencer
