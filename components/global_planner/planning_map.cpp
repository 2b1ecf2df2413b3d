#include "global_planner/planning_map.hpp"

#include <algorithm>
#include <cmath>

namespace coop::global_planner {
namespace {

constexpr double kUnderRobot =
    0.01;  ///< m: a spot whose middle is this near to the footprint is under it

}  // namespace

void PlanningMapConfig::describe(config::Fields& fields) {
  fields.integer(
      "occupied_from", occupied_from,
      {.unit = "%", .help = "map cells from here on are obstacles", .min = 1, .max = 100});
  fields.number(
      "static_tolerance", static_tolerance,
      {.unit = "m",
       .help = "what the laser sees this close to an obstacle of the map is that obstacle",
       .min = 0,
       .max = 1});
  fields.section("inflation", inflation);
  fields.section("obstacles", obstacles);
  fields.section("animals", animals);
}

PlanningMap::PlanningMap(const PlanningMapConfig& config, const Footprint& footprint,
                         double padding, double reach)
    : config_(config),
      footprint_(footprint),
      obstacle_layer_(config.obstacles),
      animal_layer_(config.animals),
      costmap_(config.inflation, footprint.half_width() + padding, reach) {}

void PlanningMap::set_map(const OccupancyGrid& map) {
  map_ = map;
  map_changed_ = true;
  static_obstacles_.resize(map.cells.size());
  std::transform(map.cells.begin(), map.cells.end(), static_obstacles_.begin(),
                 [this](std::int8_t cell) { return cell >= config_.occupied_from ? 1 : 0; });
  static_distances_.update(map.geometry, static_obstacles_,
                           config_.static_tolerance + map.geometry.resolution);
  obstacle_layer_.set_geometry(map.geometry);
}

void PlanningMap::integrate(const LaserScan& scan, const ObstacleLayer::ScanPose& pose) {
  if (has_map()) obstacle_layer_.integrate(scan, pose, footprint_);
}

void PlanningMap::set_spots(std::vector<Spot> spots) {
  spots_ = std::move(spots);
}

void PlanningMap::mark_spot(const Spot& spot, std::span<std::uint8_t> cells) const {
  const GridGeometry& grid = map_.geometry;
  const Eigen::Vector2d reach(spot.radius, spot.radius);
  const Cell low = grid.cell_of(spot.center_in_map - reach);
  const Cell high = grid.cell_of(spot.center_in_map + reach);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const Cell cell{x, y};
      const bool inside = (grid.center_of(cell) - spot.center_in_map).norm() <= spot.radius;
      if (grid.contains(cell) && (inside || cell == grid.cell_of(spot.center_in_map))) {
        cells[grid.index(cell)] = 1;
      }
    }
  }
}

bool PlanningMap::update(Time now, const std::optional<Pose2>& robot_in_map) {
  if (!has_map()) return false;
  obstacle_layer_.expire(now);
  costmap_.reset(map_.geometry);
  const std::span<std::uint8_t> obstacles = costmap_.obstacles();
  const std::span<const ObstacleLayer::State> seen = obstacle_layer_.states();
  const std::span<const std::int32_t> to_static = static_distances_.squared_cells();
  const double tolerance = config_.static_tolerance / map_.geometry.resolution;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const bool new_obstacle =
        seen[i] == ObstacleLayer::State::kMarked && to_static[i] > tolerance * tolerance;
    obstacles[i] = static_obstacles_[i] != 0 || new_obstacle ? 1 : 0;
    // What the laser looked through is known to be free, whatever the map says.
    costmap_.unknown()[i] = map_.cells[i] < 0 && seen[i] != ObstacleLayer::State::kClear ? 1 : 0;
  }
  for (const Spot& spot : spots_) {
    const bool under_robot = robot_in_map && footprint_.depth(robot_in_map->inverse() *
                                                              spot.center_in_map) > -kUnderRobot;
    if (!under_robot) mark_spot(spot, obstacles);
  }
  animal_layer_.mark(map_.geometry, now, robot_in_map, footprint_, obstacles);
  if (!map_changed_ &&
      std::equal(obstacles.begin(), obstacles.end(), marked_.begin(), marked_.end())) {
    return false;
  }
  marked_.assign(obstacles.begin(), obstacles.end());
  map_changed_ = false;
  costmap_.update();
  return true;
}

}  // namespace coop::global_planner
