#include "lidar_driver/node/log_backend.hpp"

#include <rosgraph_msgs/msg/Clock.h>

#include "conversions/sensors.hpp"
#include "core/robot/robot_model.hpp"
#include "lidar_driver/node/lidar_driver_node.hpp"

namespace coop::lidar_driver {
namespace {

using Wall = std::chrono::steady_clock;

/// Those who heard an earlier life are waited for so long; one may have left for good.
constexpr Duration kReadersReturn = std::chrono::seconds(2);
/// Scans a call: one that comes late to a log catches up in steps between which its heart beats.
constexpr int kScansPerCall = 500;

}  // namespace

LogBackend::LogBackend(runtime::Node& node, const LogConfig& config, ScanLog log)
    : node_(node),
      log_(std::move(log)),
      publisher_(node.advertise<sensor_msgs::msg::LaserScan>("scan", runtime::Qos::kSensorStream)),
      position_(node.options().run_dir / (node.name() + ".position"),
                {log_.size(), log_.begin(), log_.end()}),
      readers_(config.readers),
      settle_(seconds(config.settle)),
      patience_(seconds(config.patience)) {
  if (!node.options().sim_time) {
    node.log().warning("a log's scans follow the topic clock, but --sim-time is not set");
  }
  node.publish_static_transform(robot::kBaseLink, robot::kLaserLink,
                                to_pose3(Pose2{config.mount.x, config.mount.y, config.mount.yaw}));
  node.log().info("{}: {} scans", config.file, log_.size());
  if (const auto& mark = position_.found(); mark && config.resume) {
    log_.skip(mark->taken);
    acknowledged_ = log_.position();
    awaited_ = mark->readers;
    node.log().warning("goes on with scan {}", log_.position());
  }
  // By the clock's messages and not by a timer: they also come when the log's time is at its end.
  node.subscribe<rosgraph_msgs::msg::Clock>("clock", runtime::Qos::kEvent,
                                            [this](const rosgraph_msgs::msg::Clock&) { play(); });
  node.on_stop([this] { finish(); });
}

/// By wall time, because the log's may stand still.
bool LogBackend::readers_are_there() {
  const int readers = publisher_.subscribers();
  if (readers < readers_) return false;
  if (!heard_since_) heard_since_ = Wall::now();
  if (awaited_ > 0 && readers >= awaited_) return true;
  return Wall::now() - *heard_since_ >= (awaited_ > 0 ? kReadersReturn : settle_);
}

void LogBackend::look_for_acknowledgments() {
  if (acknowledged_ < log_.position() && publisher_.wait_for_acknowledgments(Duration{0})) {
    acknowledged_ = log_.position();
  }
  position_.write({acknowledged_, node_.now(), publisher_.subscribers()});
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
  if (node_.wants_to_end()) return;
  if (!is_playing_ && !readers_are_there()) return;
  is_playing_ = true;
  for (int i = 0; i < kScansPerCall; ++i) {
    const LaserScan* scan = log_.next(node_.now());
    if (scan == nullptr) break;
    if (!publish(*scan)) {
      node_.fail("a reader of the scans does not keep up");
      return;
    }
    log_.pop();
  }
  look_for_acknowledgments();
  if (log_.at_end()) node_.finish("the log was played to its end");
}

/// Ends only when the last scan has reached its readers.
void LogBackend::finish() {
  if (log_.at_end() && publisher_.wait_for_acknowledgments(patience_)) position_.forget();
}

}  // namespace coop::lidar_driver
