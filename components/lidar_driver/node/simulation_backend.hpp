#pragma once
#include <sensor_msgs/msg/LaserScan.h>

#include <optional>

#include "lidar_driver/simulated_lidar.hpp"
#include "runtime/world_feed.hpp"

namespace coop::lidar_driver {

struct SimulationConfig;

/// Scans of the simulator's world, one for the first ground truth at or after each multiple of the
/// scan period.
class SimulationBackend {
 public:
  SimulationBackend(runtime::Node& node, const SimulationConfig& config,
                    const Pose3& laser_in_base);

 private:
  void measure(const world::GroundTruth& truth);

  runtime::Publisher<sensor_msgs::msg::LaserScan> publisher_;
  std::optional<SimulatedLidar> lidar_;
  LaserScan scan_;
  runtime::WorldFeed feed_;
};

}  // namespace coop::lidar_driver
