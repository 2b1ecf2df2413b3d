#pragma once
#include <optional>

#include "camera_driver/egg_detector.hpp"
#include "camera_driver/node/camera_topics.hpp"
#include "camera_driver/simulated_camera.hpp"
#include "runtime/world_feed.hpp"

namespace coop::camera_driver {

struct CameraDriverConfig;

/// Pictures of the simulator's world, one for the first ground truth at or after each multiple of
/// the frame period, and the eggs found in them.
class SimulationBackend {
 public:
  SimulationBackend(runtime::Node& node, const CameraDriverConfig& config,
                    const Pose3& camera_in_base);

 private:
  void measure(const world::GroundTruth& truth);
  void displace(std::vector<Detection>& eggs, Time stamp) const;

  std::uint64_t seed_;
  double detection_error_;  ///< m
  EggDetector detector_;
  std::optional<SimulatedCamera> camera_;
  Frame frame_;
  CameraTopics topics_;
  runtime::WorldFeed feed_;
};

}  // namespace coop::camera_driver
