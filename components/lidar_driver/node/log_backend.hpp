#pragma once
#include <sensor_msgs/msg/LaserScan.h>

#include <chrono>
#include <optional>

#include "core/carmen/playback_position.hpp"
#include "lidar_driver/scan_log.hpp"
#include "runtime/node.hpp"

namespace coop::lidar_driver {

struct LogConfig;

/// Plays the scans of a log as the clock, which the base's driver moves through the same log, comes
/// to their stamps. Ends the program when the last scan was published and acknowledged.
///
/// How far it has come is in a file of the run: one that was killed goes on there and repeats the
/// scans of which it is not known that they arrived.
class LogBackend {
 public:
  LogBackend(runtime::Node& node, const LogConfig& config, ScanLog log);

 private:
  void play();
  [[nodiscard]] bool readers_are_there();
  void look_for_acknowledgments();
  [[nodiscard]] bool publish(const LaserScan& scan);
  void finish();

  runtime::Node& node_;
  ScanLog log_;
  runtime::Publisher<sensor_msgs::msg::LaserScan> publisher_;
  carmen::PlaybackPosition position_;
  std::size_t acknowledged_ = 0;  ///< scans known to have been taken in by all readers
  std::int64_t awaited_ = 0;      ///< readers an earlier life had
  int readers_;                   ///< to wait for
  bool is_playing_ = false;
  std::optional<std::chrono::steady_clock::time_point> heard_since_;
  Duration settle_;
  Duration patience_;
};

}  // namespace coop::lidar_driver
