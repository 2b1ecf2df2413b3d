#pragma once
#include <optional>
#include <string>

#include "amcl/amcl.hpp"
#include "amcl/saved_pose.hpp"
#include "core/odometry_track.hpp"
#include "core/scan_queue.hpp"
#include "geometry_msgs/msg/PoseArray.h"
#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "nav_msgs/msg/OccupancyGrid.h"
#include "nav_msgs/msg/Odometry.h"
#include "runtime/node.hpp"

namespace coop::amcl {

struct InitialPoseConfig {
  bool known = true;              ///< false: global localisation from the start
  double x = 0.0;                 ///< m in map
  double y = 0.0;                 ///< m in map
  double yaw = 0.0;               ///< rad in map
  double position_stddev = 0.15;  ///< m
  double yaw_stddev = 0.10;       ///< rad

  void describe(config::Fields& fields);
  [[nodiscard]] PoseEstimate estimate() const;
};

struct AmclNodeConfig {
  std::string map_file;  ///< YAML of the map to localise on and to serve
  InitialPoseConfig initial_pose;
  double transform_period = 0.05;  ///< s between two transforms published
  double transform_ahead =
      0.15;                   ///< s, the transform is stamped ahead, for those who look up at now
  double cloud_period = 0.5;  ///< s between two particle clouds
  double save_period = 1.0;   ///< s between two poses saved to disk
  int cloud_size = 500;       ///< particles of a cloud, at most
  OdometryRestart odometry_restart;
  AmclConfig amcl;

  void describe(config::Fields& fields);
  void validate() const { amcl.validate(); }
};

/// Shell of amcl: serves the map, localises on it, keeps the last pose on disk and goes on from it
/// after a restart.
class AmclNode {
 public:
  using Config = AmclNodeConfig;
  static void check(const Config& config);
  AmclNode(runtime::Node& node, const Config& config);

 private:
  AmclNode(runtime::Node& node, const Config& config, const OccupancyGrid& map);
  void subscribe();
  void begin(Time now, const Pose2& base_in_odom);
  void handle_clock_jump();
  void report_health();
  void process_scans();
  void take(const Estimate& estimate, const Pose2& base_in_odom);
  void publish_transform();
  void publish_cloud();
  void save_pose(const Estimate& estimate, const Pose2& base_in_odom);
  [[nodiscard]] std::filesystem::path saved_path() const;

  runtime::Node& node_;
  Config config_;
  Amcl filter_;
  std::uint64_t map_hash_;
  const TransformBuffer& transforms_;
  OdometryTrack odometry_;
  ScanQueue scans_;
  bool begun_ = false;
  std::optional<Pose2> track_in_map_;  ///< while the pose is known
  Time saved_{};
  Time last_scan_{};
  Doubt doubt_ = Doubt::kSeveralPlaces;
  runtime::Publisher<nav_msgs::msg::OccupancyGrid> map_publisher_;
  runtime::Publisher<geometry_msgs::msg::PoseWithCovarianceStamped> pose_publisher_;
  runtime::Publisher<geometry_msgs::msg::PoseArray> cloud_publisher_;
};

}  // namespace coop::amcl
