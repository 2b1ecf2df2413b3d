#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/costmap/costmap.hpp"
#include "core/costmap/footprint.hpp"
#include "core/costmap/obstacle_layer.hpp"
#include "core/costmap/spot.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/time.hpp"
#include "dwa/config.hpp"

namespace coop::dwa {

/// Square costmap that goes with the robot, in the odom frame, where the robot's pose does not
/// jump. What the laser has seen counts; where it has not looked, obstacles of the static map stand
/// in. An obstacle of the map beside one that was seen is left out: it is the same one, displaced
/// by the error of localisation.
class LocalMap {
 public:
  /// `reach`: distance that collision checks need, m.
  LocalMap(const LocalMapConfig& config, const Footprint& footprint, double reach);

  void set_static_map(const OccupancyGrid& map);
  /// Moves the square with the robot and adds the scan.
  void integrate(const LaserScan& scan, const ObstacleLayer::ScanPose& pose);

  /// Round spots to keep clear of, although the laser does not see them.
  void set_spots(std::vector<Spot> spots) {
    spots_changed_ = spots_changed_ || spots != spots_;
    spots_ = std::move(spots);
  }

  /// Brings costs and distances up to date where anything changed. `odom_in_map` places static map
  /// and spots.
  void update(const Pose2& base_in_odom, const Pose2& odom_in_map, Time now);

  [[nodiscard]] const Costmap& costmap() const { return costmap_; }
  void clear() { layer_.clear(); }

 private:
  void center_on(const Eigen::Vector2d& point);
  [[nodiscard]] bool is_up_to_date(const Pose2& base_in_odom, const Pose2& odom_in_map) const;
  void compose(const Pose2& base_in_odom, const Pose2& odom_in_map);
  void add_static(const Pose2& odom_in_map);
  void add_spots(const Pose2& base_in_odom, const Pose2& odom_in_map);
  void take_over();

  LocalMapConfig config_;
  Footprint footprint_;
  ObstacleLayer layer_;
  Costmap costmap_;
  OccupancyGrid map_;
  std::vector<Spot> spots_;
  std::vector<CellWindow> looked_at_;  ///< where the layer has changed since the last update
  std::vector<std::uint8_t> marked_;   ///< what the laser has seen
  DistanceField to_marked_;
  std::vector<std::uint8_t> obstacles_;  ///< of all layers
  std::vector<CellWindow> changed_;      ///< of these, since the last update
  // What the last update was made of.
  Pose2 base_in_odom_;
  Pose2 odom_in_map_;
  bool all_anew_ = true;
  bool spots_changed_ = false;
};

}  // namespace coop::dwa
