#include "lidar_driver/node/log_backend.hpp"

#include "conversions/sensors.hpp"
#include "core/robot/robot_model.hpp"
#include "lidar_driver/node/lidar_driver_node.hpp"

namespace coop::lidar_driver {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(10);  ///< of the log's time

}  // namespace

LogBackend::LogBackend(runtime::Node& node, const LogConfig& config, ScanLog log)
    : node_(node),
      log_(std::move(log)),
      publisher_(node.advertise<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream)),
      patience_(seconds(config.patience)) {
  if (!node.options().sim_time) {
    node.log().warning("a log's scans follow the topic clock, but --sim-time is not set");
  }
  node.publish_static_transform(robot::kBaseLink, robot::kLaserLink,
                                to_pose3(Pose2{config.mount.x, config.mount.y, config.mount.yaw}));
  node.log().info("{}: {} scans", config.file, log_.size());
  node.every(kPeriod, [this] { play(); });
  // Ends only when the last scan has reached its readers.
  node.on_stop([this] {
    if (log_.at_end()) publisher_.wait_for_acknowledgments(patience_);
  });
}

bool LogBackend::publish(const LaserScan& scan) {
  // A reader that is too slow holds the writer for some seconds a try.
  constexpr int kTries = 6;
  const auto message = conversions::to_msg(scan);
  for (int i = 0; i < kTries; ++i) {
    if (publisher_.publish(message)) return true;
  }
  return false;
}

void LogBackend::play() {
  if (log_.at_end()) return;
  while (const LaserScan* scan = log_.next(node_.now())) {
    if (!publish(*scan)) {
      node_.fail("a reader of the scans does not keep up");
      return;
    }
    log_.pop();
  }
  if (log_.at_end()) node_.finish("the log was played to its end");
}

}  // namespace coop::lidar_driver
