#include "system/mission/mission_watch.hpp"

#include <algorithm>

namespace coop::test {

using coop_msgs::msg::GroundTruth;
using coop_msgs::msg::MissionStatus;
using runtime::Qos;

MissionWatch::MissionWatch(int domain) : listener_(domain, "mission_watch") {
  listener_.node().subscribe<MissionStatus>(
      "mission_status", Qos::kStateLatched,
      [this](const MissionStatus& status) { mission_ = status; });
  listener_.node().subscribe<GroundTruth>("ground_truth", Qos::kSensorStream,
                                          [this](const GroundTruth& truth) { truth_ = truth; });
}

void MissionWatch::look() {
  listener_.look();
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
