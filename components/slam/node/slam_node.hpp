#pragma once
#include <coop_msgs/msg/SaveMap.h>
#include <coop_msgs/msg/SaveMapResult.h>
#include <nav_msgs/msg/OccupancyGrid.h>

#include <deque>
#include <filesystem>
#include <memory>
#include <string>

#include "core/scan.hpp"
#include "runtime/node.hpp"
#include "slam/fork_join.hpp"
#include "slam/odometry_track.hpp"
#include "slam/particle_filter.hpp"

namespace coop::slam {

struct SlamNodeConfig {
  std::string save_path;    ///< map at exit: <path>.pgm, .yaml, _trajectory.txt; empty: not saved
  int threads = 2;          ///< that share the particles; the result does not depend on it
  double map_period = 1.0;  ///< s between maps
  double transform_period = 0.05;    ///< s between map -> odom
  double transform_tolerance = 0.1;  ///< s that map -> odom is dated ahead
  double scan_timeout = 2.0;         ///< s without a scan until degraded; 0: never
  double odometry_patience =
      2.0;  ///< s a scan waits for its odometry; with reliable streams: for ever
  SlamConfig slam;

  void describe(config::Fields& fields);
};

/// Shell of the mapper. Scans wait until odometry has reached their end; a timer takes a few at a
/// time, so that the heart beats on; what has arrived when the program stops is still mapped, then
/// map and trajectory are saved.
class SlamNode {
 public:
  using Config = SlamNodeConfig;
  SlamNode(runtime::Node& node, const Config& config);

 private:
  void subscribe();
  void handle_clock_jump();
  void start_anew();
  /// Maps up to `limit` of the scans that wait. Answers whether there was one.
  bool process_scans(int limit);
  bool process(const LaserScan& scan);
  void publish_transform();
  void publish_map();
  void report_health();
  void answer(const coop_msgs::msg::SaveMap& request);
  void save(const std::filesystem::path& path);
  void finish();

  runtime::Node& node_;
  Config config_;
  ForkJoin workers_;
  const TransformBuffer& transforms_;  ///< for the mount of the laser
  std::unique_ptr<ParticleFilter> filter_;
  OdometryTrack odometry_;
  std::deque<LaserScan> waiting_;
  std::size_t taken_ = 0;    ///< scans
  std::size_t used_ = 0;     ///< of them: drawn into the map
  std::size_t dropped_ = 0;  ///< scans without odometry
  Time clock_{};
  Time last_scan_{};    ///< by the clock, when it came
  Time newest_scan_{};  ///< stamp
  bool map_changed_ = false;
  runtime::Publisher<nav_msgs::msg::OccupancyGrid> map_publisher_;
  runtime::Publisher<coop_msgs::msg::SaveMapResult> result_publisher_;
};

}  // namespace coop::slam
