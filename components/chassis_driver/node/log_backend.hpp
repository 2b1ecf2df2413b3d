#pragma once
#include <rosgraph_msgs/msg/Clock.h>

#include "chassis_driver/node/odometry_output.hpp"
#include "chassis_driver/odometry_log.hpp"
#include "chassis_driver/playback.hpp"
#include "runtime/node.hpp"

namespace coop::chassis_driver {

struct LogConfig;

/// Plays the odometry of a log and is the master of time meanwhile: /clock runs in the log's time.
/// A reader that is too slow holds the playback; nothing is left out. Ends the program when all was
/// played and acknowledged.
class LogBackend {
 public:
  LogBackend(runtime::Node& node, const LogConfig& config, OdometryLog log);

 private:
  void play();
  [[nodiscard]] bool readers_are_there();
  [[nodiscard]] bool time_is_announced();
  [[nodiscard]] bool readers_keep_up();
  [[nodiscard]] bool publish_until(Time step);
  void finish();

  runtime::Node& node_;
  OdometryLog log_;
  Playback playback_;
  OdometryOutput output_;
  runtime::Publisher<rosgraph_msgs::msg::Clock> clock_;
  std::size_t next_ = 0;          ///< reading to publish
  std::size_t acknowledged_ = 0;  ///< readings known to have been taken in by all readers
  bool wait_for_readers_;
  Duration settle_;
  Duration patience_;
  Time heard_since_{};   ///< wall time
  Time announced_at_{};  ///< wall time
  Time ended_at_{};      ///< wall time
};

}  // namespace coop::chassis_driver
