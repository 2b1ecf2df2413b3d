#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/costmap.hpp"
#include "core/costmap/footprint.hpp"
#include "core/costmap/obstacle_layer.hpp"
#include "core/costmap/spot.hpp"
#include "core/grid.hpp"
#include "core/scan.hpp"
#include "core/time.hpp"
#include "global_planner/animal_layer.hpp"

namespace coop::global_planner {

struct PlanningMapConfig {
  int occupied_from = 65;  ///< percent: map cells from here on are obstacles
  double static_tolerance =
      0.10;  ///< m: what the laser sees this close to an obstacle of the map is that obstacle
  InflationConfig inflation{};
  ObstacleLayerConfig obstacles{};
  AnimalLayerConfig animals{};

  void describe(config::Fields& fields);
};

/// The global costmap, in the map's frame, out of three layers as in the egg paper's section 2.2.1:
/// the static map, what the laser sees beyond it (raytraced marking and clearing), and inflation;
/// and round spots to keep clear of (eggs), and animals where they are about to go.
///
/// The inscribed zone reaches to the half width of the padded footprint, not to the largest disc
/// about base_link, which at the rear axle is smaller: whoever drives along a path needs the half
/// width on each side.
class PlanningMap {
 public:
  /// `padding`: m around the footprint. `reach`: distance that collision checks need, m.
  PlanningMap(const PlanningMapConfig& config, const Footprint& footprint, double padding,
              double reach);

  /// A map may grow, shift by whole cells and change; what the laser saw is kept.
  void set_map(const OccupancyGrid& map);
  [[nodiscard]] bool has_map() const { return map_.geometry.size() > 0; }
  /// A scan; ignored while there is no map.
  void integrate(const LaserScan& scan, const ObstacleLayer::ScanPose& pose);

  void set_spots(std::vector<Spot> spots);
  [[nodiscard]] AnimalLayer& animals() { return animal_layer_; }

  /// Brings costs and distances up to date where anything changed; whether an obstacle did. Spots
  /// under the robot, where it is known, are left out: it stands there, so nothing is, or it is too
  /// late.
  bool update(Time now, const std::optional<Pose2>& robot_in_map = std::nullopt);

  [[nodiscard]] const Costmap& costmap() const { return costmap_; }
  [[nodiscard]] const OccupancyGrid& map() const { return map_; }

 private:
  void cover_spot(const Spot& spot, std::vector<std::size_t>& cells) const;
  void cover(Time now, const std::optional<Pose2>& robot_in_map);
  void compose(std::size_t cell);

  PlanningMapConfig config_;
  Footprint footprint_;
  OccupancyGrid map_;
  std::vector<std::uint8_t> static_obstacles_;
  DistanceField static_distances_;
  double squared_tolerance_ = 0.0;  ///< cells
  ObstacleLayer obstacle_layer_;
  AnimalLayer animal_layer_;
  std::vector<Spot> spots_;
  Costmap costmap_;
  std::vector<std::size_t> covered_;         ///< cells of spots and animals
  std::vector<std::size_t> covered_before_;  ///< at the last update
  std::vector<std::uint8_t> is_covered_;     ///< the same as covered_, a cell each
  std::vector<CellWindow> seen_;             ///< where the laser's layer has changed
  std::vector<CellWindow> changed_;          ///< since costs and distances were brought up to date
  bool obstacles_changed_ = false;
  bool map_changed_ = false;
};

}  // namespace coop::global_planner
