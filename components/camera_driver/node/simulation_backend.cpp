#include "camera_driver/node/simulation_backend.hpp"

#include <utility>

#include "camera_driver/node/camera_driver_node.hpp"
#include "conversions/world.hpp"

namespace coop::camera_driver {
namespace {

using runtime::Qos;

/// Ground truth comes at 50 Hz; without it for this long there are no pictures to speak of.
constexpr Duration kTruthTimeout = std::chrono::milliseconds(500);

}  // namespace

SimulationBackend::SimulationBackend(runtime::Node& node, const CameraDriverConfig& config,
                                     const Pose3& camera_in_base)
    : node_(node),
      config_(config.sim.camera),
      period_(seconds(1.0 / config.sim.rate)),
      camera_in_base_(camera_in_base),
      detector_(config.detector, d435i_intrinsics(config_.width, config_.height), camera_in_base_),
      topics_(node) {
  node.subscribe<coop_msgs::msg::World>(
      "world", Qos::kStateLatched,
      [this](const coop_msgs::msg::World& message) { receive_world(message); });
  node.subscribe<coop_msgs::msg::GroundTruth>(
      "ground_truth", Qos::kSensorStream,
      [this](const coop_msgs::msg::GroundTruth& message) { receive_truth(message); });
  node.every(kTruthTimeout / 5, [this] { check_freshness(); });
}

void SimulationBackend::receive_world(const coop_msgs::msg::World& message) {
  const auto world = conversions::from_msg(message);
  if (!world) {
    node_.log().warning("refused a world: {}", world.error());
    return;
  }
  camera_.emplace(config_, *world, camera_in_base_, node_.options().seed);
}

void SimulationBackend::receive_truth(const coop_msgs::msg::GroundTruth& message) {
  const auto truth = conversions::from_msg(message);
  if (!truth) {
    if (node_.log().is_due("truth", seconds(5))) {
      node_.log().warning("refused a ground truth: {}", truth.error());
    }
    return;
  }
  last_truth_ = truth->stamp;
  if (!camera_) return;
  const std::int64_t turn = to_nanoseconds(truth->stamp) / period_.count();
  const bool is_first = last_turn_ < 0;  // somewhere within a period: wait for its end
  if (turn == std::exchange(last_turn_, turn) || is_first) return;
  camera_->take(*truth, frame_);
  topics_.publish(frame_, camera_->intrinsics());
  topics_.publish(frame_.stamp, detector_.detect(frame_));
}

void SimulationBackend::check_freshness() {
  if (!camera_) {
    node_.set_degraded("no world yet");
  } else if (last_truth_ == Time{} || node_.now() - last_truth_ > kTruthTimeout) {
    node_.set_degraded("no ground truth");
  } else {
    node_.set_ready();
  }
}

}  // namespace coop::camera_driver
