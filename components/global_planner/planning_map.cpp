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
  const double tolerance = config_.static_tolerance / map.geometry.resolution;
  squared_tolerance_ = tolerance * tolerance;
  obstacle_layer_.set_geometry(map.geometry);
}

void PlanningMap::integrate(const LaserScan& scan, const ObstacleLayer::ScanPose& pose) {
  if (has_map()) obstacle_layer_.integrate(scan, pose, footprint_);
}

void PlanningMap::set_spots(std::vector<Spot> spots) {
  spots_ = std::move(spots);
}

void PlanningMap::cover_spot(const Spot& spot, std::vector<std::size_t>& cells) const {
  const GridGeometry& grid = map_.geometry;
  const Eigen::Vector2d reach(spot.radius, spot.radius);
  const Cell low = grid.cell_of(spot.center_in_map - reach);
  const Cell high = grid.cell_of(spot.center_in_map + reach);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const Cell cell{x, y};
      const bool inside = (grid.center_of(cell) - spot.center_in_map).norm() <= spot.radius;
      if (grid.contains(cell) && (inside || cell == grid.cell_of(spot.center_in_map))) {
        cells.push_back(grid.index(cell));
      }
    }
  }
}

void PlanningMap::cover(Time now, const std::optional<Pose2>& robot_in_map) {
  std::swap(covered_, covered_before_);
  for (const std::size_t cell : covered_before_) is_covered_[cell] = 0;
  covered_.clear();
  for (const Spot& spot : spots_) {
    const bool under_robot = robot_in_map && footprint_.depth(robot_in_map->inverse() *
                                                              spot.center_in_map) > -kUnderRobot;
    if (!under_robot) cover_spot(spot, covered_);
  }
  animal_layer_.cover(map_.geometry, now, robot_in_map, footprint_, covered_);
  for (const std::size_t cell : covered_) is_covered_[cell] = 1;
}

/// What one cell is, of all layers; remembers it as changed where it was something else.
void PlanningMap::compose(std::size_t i) {
  const ObstacleLayer::State seen = obstacle_layer_.states()[i];
  const bool new_obstacle = seen == ObstacleLayer::State::kMarked &&
                            static_distances_.squared_cells()[i] > squared_tolerance_;
  const std::uint8_t obstacle =
      static_obstacles_[i] != 0 || new_obstacle || is_covered_[i] != 0 ? 1 : 0;
  // What the laser looked through is known to be free, whatever the map says.
  const std::uint8_t unknown = map_.cells[i] < 0 && seen != ObstacleLayer::State::kClear ? 1 : 0;
  std::uint8_t& obstacle_now = costmap_.obstacles()[i];
  std::uint8_t& unknown_now = costmap_.unknown()[i];
  if (obstacle == obstacle_now && unknown == unknown_now) return;
  obstacles_changed_ = obstacles_changed_ || obstacle != obstacle_now;
  obstacle_now = obstacle;
  unknown_now = unknown;
  const Cell cell = map_.geometry.cell_at(i);
  const bool goes_on =
      !changed_.empty() && changed_.back().low.y == cell.y && changed_.back().high.x == cell.x;
  if (goes_on) {
    ++changed_.back().high.x;
  } else {
    changed_.push_back({cell, {cell.x + 1, cell.y + 1}});
  }
}

bool PlanningMap::update(Time now, const std::optional<Pose2>& robot_in_map) {
  if (!has_map()) return false;
  obstacle_layer_.expire(now);
  obstacle_layer_.take_changes(seen_);
  const GridGeometry& grid = map_.geometry;
  if (map_changed_) {
    costmap_.reset(grid);
    is_covered_.assign(grid.size(), 0);
    covered_.clear();
    seen_.assign(1, {{0, 0}, {grid.width, grid.height}});
  }
  cover(now, robot_in_map);
  for (const CellWindow& window : seen_) {
    for (int y = window.low.y; y < window.high.y; ++y) {
      for (int x = window.low.x; x < window.high.x; ++x) compose(grid.index({x, y}));
    }
  }
  for (const std::size_t cell : covered_before_) compose(cell);
  for (const std::size_t cell : covered_) compose(cell);
  if (!map_changed_ && !obstacles_changed_) {
    // What is known or not waits for the next obstacle, but not in a list without end.
    if (changed_.size() > grid.size() / 16) changed_.assign(1, {{0, 0}, {grid.width, grid.height}});
    return false;
  }
  costmap_.update(changed_);
  changed_.clear();
  obstacles_changed_ = false;
  map_changed_ = false;
  return true;
}

}  // namespace coop::global_planner
