#include "lidar_driver/node/simulation_backend.hpp"

#include <utility>

#include "conversions/sensors.hpp"
#include "conversions/world.hpp"
#include "core/robot/robot_model.hpp"
#include "lidar_driver/node/lidar_driver_node.hpp"

namespace coop::lidar_driver {
namespace {

using runtime::Qos;

/// Ground truth comes at 50 Hz; without it for this long there are no scans to speak of.
constexpr Duration kTruthTimeout = std::chrono::milliseconds(500);

}  // namespace

SimulationBackend::SimulationBackend(runtime::Node& node, const SimulationConfig& config,
                                     const Pose3& laser_in_base)
    : node_(node),
      config_(config.lidar),
      period_(seconds(1.0 / config.rate)),
      laser_in_base_(to_pose2(laser_in_base)),
      publisher_(node.advertise<sensor_msgs::msg::LaserScan>("scan", Qos::kSensorStream)) {
  scan_.scan_time = static_cast<float>(to_seconds(period_));
  node.publish_static_transform(robot::kBaseLink, robot::kLaserLink, laser_in_base);
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
  lidar_.emplace(config_, *world, laser_in_base_, node_.options().seed);
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
  if (!lidar_) return;
  const std::int64_t turn = to_nanoseconds(truth->stamp) / period_.count();
  const bool is_first = last_turn_ < 0;  // somewhere within a period: wait for its end
  if (turn == std::exchange(last_turn_, turn) || is_first) return;
  lidar_->measure(*truth, scan_);
  publisher_.publish(conversions::to_msg(scan_));
}

void SimulationBackend::check_freshness() {
  if (!lidar_) {
    node_.set_degraded("no world yet");
  } else if (last_truth_ == Time{} || node_.now() - last_truth_ > kTruthTimeout) {
    node_.set_degraded("no ground truth");
  } else {
    node_.set_ready();
  }
}

}  // namespace coop::lidar_driver
