#pragma once
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>
#include <sensor_msgs/msg/LaserScan.h>

#include <optional>

#include "lidar_driver/simulated_lidar.hpp"
#include "runtime/node.hpp"

namespace coop::lidar_driver {

struct SimulationConfig;

/// Scans of the simulator's world, one for the first ground truth at or after each multiple of the
/// scan period.
class SimulationBackend {
 public:
  SimulationBackend(runtime::Node& node, const SimulationConfig& config,
                    const Pose3& laser_in_base);

 private:
  void receive_world(const coop_msgs::msg::World& message);
  void receive_truth(const coop_msgs::msg::GroundTruth& message);
  void check_freshness();

  runtime::Node& node_;
  SimulatedLidarConfig config_;
  Duration period_;
  Pose2 laser_in_base_;
  std::optional<SimulatedLidar> lidar_;
  LaserScan scan_;
  std::int64_t last_turn_ = -1;  ///< number of the scan period of the last scan
  Time last_truth_{};
  runtime::Publisher<sensor_msgs::msg::LaserScan> publisher_;
};

}  // namespace coop::lidar_driver
