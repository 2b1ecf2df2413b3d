#pragma once
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>

#include <optional>

#include "camera_driver/egg_detector.hpp"
#include "camera_driver/node/camera_topics.hpp"
#include "camera_driver/simulated_camera.hpp"
#include "runtime/node.hpp"

namespace coop::camera_driver {

struct CameraDriverConfig;

/// Pictures of the simulator's world, one for the first ground truth at or after each multiple of
/// the frame period, and the eggs found in them.
class SimulationBackend {
 public:
  SimulationBackend(runtime::Node& node, const CameraDriverConfig& config,
                    const Pose3& camera_in_base);

 private:
  void receive_world(const coop_msgs::msg::World& message);
  void receive_truth(const coop_msgs::msg::GroundTruth& message);
  void check_freshness();

  runtime::Node& node_;
  SimulatedCameraConfig config_;
  Duration period_;
  Pose3 camera_in_base_;
  EggDetector detector_;
  std::optional<SimulatedCamera> camera_;
  Frame frame_;
  std::int64_t last_turn_ = -1;  ///< number of the frame period of the last frame
  Time last_truth_{};
  CameraTopics topics_;
};

}  // namespace coop::camera_driver
