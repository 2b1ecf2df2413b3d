#include "system/mission/mission_watch.hpp"

#include <algorithm>

namespace coop::test {

using coop_msgs::msg::GroundTruth;
using coop_msgs::msg::MissionStatus;
using runtime::Qos;

namespace {

runtime::Options options() {
  runtime::Options options;
  options.name = "mission_watch";
  return options;
}

}  // namespace

MissionWatch::MissionWatch(int domain)
    : transport_({.domain = domain, .participant_name = "mission_watch", .partition = {}}),
      executor_(clock_),
      node_(options(), transport_, clock_, executor_) {
  node_.subscribe<MissionStatus>("mission_status", Qos::kStateLatched,
                                 [this](const MissionStatus& status) { mission_ = status; });
  node_.subscribe<GroundTruth>("ground_truth", Qos::kSensorStream,
                               [this](const GroundTruth& truth) { truth_ = truth; });
}

void MissionWatch::look() {
  executor_.run_once();
}

int MissionWatch::eggs_picked() const {
  return static_cast<int>(std::ranges::count(mission_.eggs(),
                                             coop_msgs::msg::EggStatus_Constants::PICKED,
                                             [](const auto& egg) { return egg.state(); }));
}

int MissionWatch::eggs_collected() const {
  return static_cast<int>(std::ranges::count(truth_.eggs(),
                                             coop_msgs::msg::SimEgg_Constants::COLLECTED,
                                             [](const auto& egg) { return egg.state(); }));
}

bool MissionWatch::is_done() const {
  return mission_.state() == coop_msgs::msg::MissionStatus_Constants::DONE;
}

}  // namespace coop::test
