#pragma once
#include <rosgraph_msgs/msg/Clock.h>

#include <optional>

#include "chassis_driver/node/odometry_output.hpp"
#include "chassis_driver/odometry_log.hpp"
#include "chassis_driver/playback.hpp"
#include "core/carmen/playback_position.hpp"
#include "runtime/node.hpp"

namespace coop::chassis_driver {

struct LogConfig;

/// Plays the odometry of a log and is the master of time meanwhile: /clock runs in the log's time.
/// A reader that is too slow holds the playback; nothing is left out. Ends the program when all was
/// played and acknowledged, or stays and goes on telling the log's last time.
///
/// How far it has come is in a file of the run: one that was killed goes on there, repeats the
/// readings of which it is not known that they arrived, and never sets the clock back.
class LogBackend {
 public:
  LogBackend(runtime::Node& node, const LogConfig& config, OdometryLog log);

 private:
  void resume();
  void play();
  [[nodiscard]] bool readers_are_there();
  [[nodiscard]] bool time_is_announced();
  void look_for_acknowledgments();
  [[nodiscard]] bool readers_keep_up();
  [[nodiscard]] bool publish_until(Time step);
  void finish();
  void remind();

  runtime::Node& node_;
  OdometryLog log_;
  Playback playback_;
  OdometryOutput output_;
  runtime::Publisher<rosgraph_msgs::msg::Clock> clock_;
  carmen::PlaybackPosition position_;
  std::size_t next_ = 0;          ///< reading to publish
  std::size_t acknowledged_ = 0;  ///< readings known to have been taken in by all readers
  std::optional<carmen::PlaybackPosition::Mark> resumed_;  ///< where an earlier life had come to
  int readers_;                                            ///< to wait for
  bool stays_;
  Duration settle_;
  Duration patience_;
  Time heard_since_{};   ///< wall time
  Time announced_at_{};  ///< wall time
  Time sure_at_{};       ///< wall time at which all was known to be acknowledged
  Time ended_at_{};      ///< wall time
  Time reminded_at_{};   ///< wall time
};

}  // namespace coop::chassis_driver
