#include "dwa/local_map.hpp"

#include <algorithm>
#include <cmath>

namespace coop::dwa {
namespace {

constexpr double kUnderRobot =
    0.01;  ///< m: a spot whose middle is this near to the footprint is under it
/// With more than this share of the cells changed, measuring all of them anew is no dearer.
constexpr std::size_t kFewOf = 20;

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
  all_anew_ = true;
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
  layer_.take_changes(looked_at_);
  if (!(costmap_.geometry() == layer_.geometry())) {
    costmap_.reset(layer_.geometry());
    all_anew_ = true;
  }
  if (is_up_to_date(base_in_odom, odom_in_map)) return;
  compose(base_in_odom, odom_in_map);
  take_over();
  base_in_odom_ = base_in_odom;
  odom_in_map_ = odom_in_map;
  all_anew_ = false;
  spots_changed_ = false;
}

bool LocalMap::is_up_to_date(const Pose2& base_in_odom, const Pose2& odom_in_map) const {
  // Spots count but for those under the robot.
  return !all_anew_ && !spots_changed_ && looked_at_.empty() && odom_in_map == odom_in_map_ &&
         (spots_.empty() || base_in_odom == base_in_odom_);
}

void LocalMap::compose(const Pose2& base_in_odom, const Pose2& odom_in_map) {
  const std::span<const ObstacleLayer::State> states = layer_.states();
  marked_.resize(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    marked_[i] = states[i] == ObstacleLayer::State::kMarked ? 1 : 0;
  }
  obstacles_ = marked_;
  if (config_.use_map && map_.geometry.size() > 0) add_static(odom_in_map);
  add_spots(base_in_odom, odom_in_map);
}

void LocalMap::add_spots(const Pose2& base_in_odom, const Pose2& odom_in_map) {
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
        if ((grid.center_of(cell) - center).norm() <= spot.radius) obstacles_[grid.index(cell)] = 1;
      }
    }
  }
}

/// Gives the costmap the obstacles, as runs of changed cells where these are few.
void LocalMap::take_over() {
  const GridGeometry& grid = layer_.geometry();
  const std::span<std::uint8_t> now = costmap_.obstacles();
  changed_.clear();
  std::size_t cells = 0;
  for (int y = 0; y < grid.height; ++y) {
    const std::size_t row = grid.index({0, y});
    const auto differs = [&](int x) {
      return obstacles_[row + static_cast<std::size_t>(x)] !=
             now[row + static_cast<std::size_t>(x)];
    };
    for (int x = 0; x < grid.width; ++x) {
      if (!differs(x)) continue;
      const int first = x;
      while (x < grid.width && differs(x)) ++x;
      changed_.push_back({{first, y}, {x, y + 1}});
      cells += static_cast<std::size_t>(x - first);
    }
  }
  std::ranges::copy(obstacles_, now.begin());
  if (all_anew_ || cells > grid.size() / kFewOf) {
    costmap_.update();
  } else {
    costmap_.update(changed_);
  }
}

void LocalMap::add_static(const Pose2& odom_in_map) {
  const GridGeometry& grid = layer_.geometry();
  const std::span<const ObstacleLayer::State> states = layer_.states();
  if (all_anew_) {
    to_marked_.update(grid, marked_, config_.static_tolerance + grid.resolution);
  } else {
    to_marked_.update_within(looked_at_, marked_);
  }
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
      if (to_marked_.squared_cells()[i] > tolerance * tolerance) obstacles_[i] = 1;
    }
  }
}

}  // namespace coop::dwa
