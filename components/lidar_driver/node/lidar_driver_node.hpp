#pragma once
#include <memory>
#include <string>

#include "lidar_driver/scan_log.hpp"
#include "lidar_driver/simulated_lidar.hpp"
#include "runtime/node.hpp"

namespace coop::lidar_driver {

struct SimulationConfig {
  double rate = 10.0;  ///< Hz, of simulated time
  SimulatedLidarConfig lidar;

  void describe(config::Fields& fields);
};

struct MountConfig {
  double x = 0.0;    ///< m, laser_link in base_link
  double y = 0.0;    ///< m
  double yaw = 0.0;  ///< rad

  void describe(config::Fields& fields);
};

struct LogConfig {
  std::string file;  ///< CARMEN log
  LogSection section;
  MountConfig mount;
  int readers = 1;         ///< start when so many hear the scans
  double settle = 0.3;     ///< s of wall time between that and the start
  bool resume = true;      ///< go on where an earlier life of this run was killed
  double patience = 60.0;  ///< s of wall time that readers may take to acknowledge the last scans

  void describe(config::Fields& fields);
};

struct LidarDriverConfig {
  std::string backend = "sim";  ///< "sim" or "log"
  std::string robot = "config/robot/egg_collector.urdf";
  SimulationConfig sim;
  LogConfig log;

  void describe(config::Fields& fields);
  void validate() const { sim.lidar.validate(); }
};

/// The lidar driver as a component; where scans come from is up to the backend.
class LidarDriverNode {
 public:
  using Config = LidarDriverConfig;
  /// Throws where the files that the backend needs cannot be used.
  static void check(const Config& config);

  LidarDriverNode(runtime::Node& node, const Config& config);

 private:
  std::shared_ptr<void> backend_;
};

}  // namespace coop::lidar_driver
