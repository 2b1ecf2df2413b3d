#pragma once
#include <memory>
#include <string>

#include "chassis_driver/chassis.hpp"
#include "chassis_driver/playback.hpp"
#include "runtime/node.hpp"

namespace coop::chassis_driver {

struct LogConfig {
  std::string file;  ///< CARMEN log
  PlaybackConfig playback;
  int readers = 1;                ///< start when so many hear clock and odom
  double settle = 0.5;            ///< s of wall time between that and the start
  bool resume = true;             ///< go on where an earlier life of this run was killed
  std::string at_end = "finish";  ///< "finish": the program ends; "stay": /clock goes on being told
  double patience =
      60.0;  ///< s of wall time that readers may take to acknowledge the last messages

  void describe(config::Fields& fields);
};

struct ChassisDriverConfig {
  std::string backend = "loopback";  ///< "loopback" or "log"
  std::string robot = "config/robot/egg_collector.urdf";
  double rate = 50.0;  ///< Hz, control cycle and odometry of the loopback
  ChassisConfig chassis;
  LogConfig log;

  void describe(config::Fields& fields);
};

/// The chassis driver as a component; what it does is up to the backend.
class ChassisDriverNode {
 public:
  using Config = ChassisDriverConfig;
  /// Throws where the files that the backend needs cannot be used.
  static void check(const Config& config);

  ChassisDriverNode(runtime::Node& node, const Config& config);

 private:
  std::shared_ptr<void> backend_;
};

}  // namespace coop::chassis_driver
