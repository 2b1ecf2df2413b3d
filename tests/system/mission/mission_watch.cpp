#include "system/mission/mission_watch.hpp"

#include <algorithm>

#include "conversions/detections.hpp"
#include "conversions/time.hpp"

namespace coop::test {

using coop_msgs::msg::GroundTruth;
using coop_msgs::msg::MissionStatus;
using runtime::Qos;

MissionWatch::MissionWatch(int domain)
    : listener_(domain, "mission_watch"),
      eggs_(listener_.node().advertise<vision_msgs::msg::Detection3DArray>("eggs", Qos::kEvent)) {
  subscribe();
}

MissionWatch::MissionWatch(const runtime::DdsOptions& dds) : listener_(dds) {
  subscribe();
}

void MissionWatch::subscribe() {
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

int MissionWatch::eggs_missing() const {
  return static_cast<int>(std::ranges::count(mission_.eggs(),
                                             coop_msgs::msg::EggStatus_Constants::MISSING,
                                             [](const auto& egg) { return egg.state(); }));
}

void MissionWatch::pretend_egg(double x, double y) {
  const auto now = conversions::from_msg(truth_.header().stamp());
  Detection egg;
  egg.class_id = "egg";
  egg.score = 0.9;
  egg.position = {x, y, 0.02};
  egg.covariance = 1e-4 * Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    const Time stamp = now.value_or(Time{}) + std::chrono::milliseconds(i);
    eggs_.publish(conversions::to_msg(Stamped<std::vector<Detection>>{stamp, "map", {egg}}));
  }
}

int MissionWatch::eggs_collected() const {
  return static_cast<int>(std::ranges::count(truth_.eggs(),
                                             coop_msgs::msg::SimEgg_Constants::COLLECTED,
                                             [](const auto& egg) { return egg.state(); }));
}

int MissionWatch::heaps_cleaned() const {
  return static_cast<int>(std::ranges::count(truth_.heaps(),
                                             coop_msgs::msg::SimHeap_Constants::CLEANED,
                                             [](const auto& heap) { return heap.state(); }));
}

bool MissionWatch::is_done() const {
  return mission_.state() == coop_msgs::msg::MissionStatus_Constants::DONE;
}

}  // namespace coop::test
