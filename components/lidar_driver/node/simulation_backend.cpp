#include "lidar_driver/node/simulation_backend.hpp"

#include "conversions/sensors.hpp"
#include "core/robot/robot_model.hpp"
#include "lidar_driver/node/lidar_driver_node.hpp"

namespace coop::lidar_driver {

SimulationBackend::SimulationBackend(runtime::Node& node, const SimulationConfig& config,
                                     const Pose3& laser_in_base)
    : publisher_(node.advertise<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream)),
      feed_(node, config.rate,
            {.world =
                 [this, &node, lidar = config.lidar,
                  mount = to_pose2(laser_in_base)](const world::World& world) {
                   lidar_.emplace(lidar, world, mount, node.options().seed);
                 },
             .measure = [this](const world::GroundTruth& truth) { measure(truth); }}) {
  scan_.scan_time = static_cast<float>(to_seconds(feed_.period()));
  node.publish_static_transform(robot::kBaseLink, robot::kLaserLink, laser_in_base);
}

void SimulationBackend::measure(const world::GroundTruth& truth) {
  lidar_->measure(truth, scan_);
  publisher_.publish(conversions::to_msg(scan_));
}

}  // namespace coop::lidar_driver
