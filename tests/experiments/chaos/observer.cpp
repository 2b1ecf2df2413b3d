#include "experiments/chaos/observer.hpp"

#include <cmath>

#include "conversions/time.hpp"

namespace coop::chaos {
namespace {

constexpr std::size_t kMotionKept = 6000;  // two minutes at 50 Hz

}  // namespace

Observer::Observer(int domain)
    : components_(domain),
      clock_(
          components_.node().advertise<rosgraph_msgs::msg::Clock>("clock", runtime::Qos::kEvent)) {
  components_.node().subscribe<coop_msgs::msg::MissionStatus>(
      "mission_status", runtime::Qos::kStateLatched,
      [this](const coop_msgs::msg::MissionStatus& status) { mission_ = status; });
  components_.node().subscribe<coop_msgs::msg::GroundTruth>(
      "ground_truth", runtime::Qos::kSensorStream,
      [this](const coop_msgs::msg::GroundTruth& truth) {
        const auto& from = truth_.robot().position();
        const auto& to = truth.robot().position();
        if (!motion_.empty()) gone_ += std::hypot(to.x() - from.x(), to.y() - from.y());
        truth_ = truth;
        motion_.push_back({simulated(), gone_});
        if (motion_.size() > kMotionKept) motion_.pop_front();
      });
}

double Observer::simulated() const {
  const auto stamp = conversions::from_msg(truth_.header().stamp());
  return stamp ? to_seconds(stamp->time_since_epoch()) : 0.0;
}

bool Observer::is_over() const {
  namespace State = coop_msgs::msg::MissionStatus_Constants;
  return mission_.state() == State::DONE || mission_.state() == State::FAILED;
}

std::vector<Motion> Observer::motion_since(double begin) const {
  std::vector<Motion> out;
  for (const Motion& motion : motion_) {
    if (motion.time >= begin) out.push_back(motion);
  }
  return out;
}

void Observer::tell_wrong_time(double offset) {
  clock_.publish(conversions::to_clock_msg(time_from_seconds(std::max(0.1, simulated() + offset))));
}

}  // namespace coop::chaos
