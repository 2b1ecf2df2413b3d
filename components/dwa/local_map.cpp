#include "dwa/local_map.hpp"

#include <cmath>

namespace coop::dwa {
namespace {

constexpr double kUnderRobot =
    0.01;  ///< m: a spot whose middle is this near to the footprint is under it

}  // namespace

LocalMap::LocalMap(const LocalMapConfig& config, const Footprint& footprint, double reach)
    : config_(config),
      footprint_(footprint),
      layer_(config.obstacles),
      costmap_(config.inflation, footprint.half_width(), reach) {
  center_on({0.0, 0.0});
}

void LocalMap::set_static_map(const OccupancyGrid& map) {
  map_ = map;
}

void LocalMap::center_on(const Eigen::Vector2d& point) {
  const double resolution = config_.resolution;
  const int side = static_cast<int>(std::lround(config_.size / resolution));
  const Eigen::Vector2d corner = point - Eigen::Vector2d::Constant(0.5 * side * resolution);
  const Eigen::Vector2d aligned = (corner / resolution).array().round() * resolution;
  const GridGeometry& now = layer_.geometry();
  const double moved = (aligned - now.origin).cwiseAbs().maxCoeff();
  // Moving the square copies it, so it moves in leaps.
  if (now.width == side && moved < config_.size / 16.0) return;
  layer_.set_geometry({side, side, resolution, aligned});
}

void LocalMap::integrate(const LaserScan& scan, const ObstacleLayer::ScanPose& pose) {
  center_on(pose.base_in_grid_last.position());
  layer_.integrate(scan, pose, footprint_);
}

void LocalMap::update(const Pose2& base_in_odom, const Pose2& odom_in_map, Time now) {
  center_on(base_in_odom.position());
  layer_.expire(now);
  costmap_.reset(layer_.geometry());
  const std::span<std::uint8_t> obstacles = costmap_.obstacles();
  const std::span<const ObstacleLayer::State> states = layer_.states();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    obstacles[i] = states[i] == ObstacleLayer::State::kMarked ? 1 : 0;
  }
  if (config_.use_map && map_.geometry.size() > 0) add_static(obstacles, odom_in_map);
  const GridGeometry& grid = layer_.geometry();
  const Pose2 map_in_odom = odom_in_map.inverse();
  for (const Spot& spot : spots_) {
    const Eigen::Vector2d center = map_in_odom * spot.center_in_map;
    // It stands there, so nothing is, or it is too late.
    if (footprint_.depth(base_in_odom.inverse() * center) > -kUnderRobot) continue;
    const int reach = static_cast<int>(std::ceil(spot.radius / grid.resolution));
    const Cell middle = grid.cell_of(center);
    for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
      for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
        const Cell cell{x, y};
        if (!grid.contains(cell)) continue;
        if ((grid.center_of(cell) - center).norm() <= spot.radius) obstacles[grid.index(cell)] = 1;
      }
    }
  }
  costmap_.update();
}

void LocalMap::add_static(std::span<std::uint8_t> obstacles, const Pose2& odom_in_map) {
  const GridGeometry& grid = layer_.geometry();
  const std::span<const ObstacleLayer::State> states = layer_.states();
  marked_.assign(obstacles.begin(), obstacles.end());
  seen_.update(grid, marked_, config_.static_tolerance + grid.resolution);
  const double tolerance = config_.static_tolerance / grid.resolution;
  const double c = std::cos(odom_in_map.yaw) * grid.resolution;
  const double s = std::sin(odom_in_map.yaw) * grid.resolution;
  const Eigen::Vector2d first = odom_in_map * grid.center_of({0, 0});
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const std::size_t i = grid.index({x, y});
      if (states[i] != ObstacleLayer::State::kUnseen) continue;
      const Eigen::Vector2d point(first.x() + c * x - s * y, first.y() + s * x + c * y);
      if (map_.at_or(map_.geometry.cell_of(point), kFree) < config_.occupied_from) continue;
      if (seen_.squared_cells()[i] > tolerance * tolerance) obstacles[i] = 1;
    }
  }
}

}  // namespace coop::dwa
