#pragma once
#include <sensor_msgs/msg/LaserScan.h>

#include "lidar_driver/scan_log.hpp"
#include "runtime/node.hpp"

namespace coop::lidar_driver {

struct LogConfig;

/// Plays the scans of a log as the clock, which the base's driver moves through the same log, comes
/// to their stamps. Ends the program when the last scan was published and acknowledged.
class LogBackend {
 public:
  LogBackend(runtime::Node& node, const LogConfig& config, ScanLog log);

 private:
  void play();
  [[nodiscard]] bool publish(const LaserScan& scan);

  runtime::Node& node_;
  ScanLog log_;
  runtime::Publisher<sensor_msgs::msg::LaserScan> publisher_;
  Duration patience_;
};

}  // namespace coop::lidar_driver
