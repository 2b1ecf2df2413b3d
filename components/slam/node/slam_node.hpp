#pragma once
#include <coop_msgs/msg/SaveMap.h>
#include <coop_msgs/msg/SaveMapResult.h>
#include <nav_msgs/msg/OccupancyGrid.h>

#include <filesystem>
#include <memory>
#include <string>

#include "core/odometry_track.hpp"
#include "core/scan_queue.hpp"
#include "runtime/node.hpp"
#include "slam/fork_join.hpp"
#include "slam/node/session_keeper.hpp"
#include "slam/node/slam_node_config.hpp"
#include "slam/particle_filter.hpp"

namespace coop::slam {

/// Shell of the mapper. Scans wait until odometry has reached their end; a timer takes a few at a
/// time, so that the heart beats on; what has arrived when the program stops is still mapped, then
/// map and trajectory are saved. Where one that was killed left a session, its map goes on.
class SlamNode {
 public:
  using Config = SlamNodeConfig;
  SlamNode(runtime::Node& node, const Config& config);

 private:
  void subscribe();
  void handle_clock_jump();
  void start_anew();
  void resume();
  void take_odometry(const StampedPose2& base_in_odom, std::string_view source);
  void keep_session(bool wait);
  /// Maps up to `limit` of the scans that wait. Answers whether there was one.
  bool process_scans(int limit);
  void process(const LocatedScan& located);
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
  ScanQueue waiting_;
  SessionKeeper keeper_;
  std::size_t taken_ = 0;    ///< scans
  std::size_t used_ = 0;     ///< of them: drawn into the map
  std::size_t kept_ = 0;     ///< of used_, in the last session
  std::size_t dropped_ = 0;  ///< of the scans dropped: told
  std::size_t lost_ = 0;     ///< scans on end that did not find their place
  bool resumed_ = false;     ///< the map is that of a session and the robot not found in it yet
  Time clock_{};
  Time last_scan_{};    ///< by the clock, when it came
  Time newest_scan_{};  ///< stamp
  bool map_changed_ = false;
  runtime::Publisher<nav_msgs::msg::OccupancyGrid> map_publisher_;
  runtime::Publisher<coop_msgs::msg::SaveMapResult> result_publisher_;
};

}  // namespace coop::slam
