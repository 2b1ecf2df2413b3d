#include "experiments/navigation/duck_house.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/costmap/collision_checker.hpp"

namespace coop::test {
namespace {

void fill(OccupancyGrid& grid, double x, double y, double width, double height) {
  const Cell low = grid.geometry.cell_of({x + 1e-6, y + 1e-6});
  const Cell high = grid.geometry.cell_of({x + width - 1e-6, y + height - 1e-6});
  for (int cy = low.y; cy <= high.y; ++cy) {
    for (int cx = low.x; cx <= high.x; ++cx) grid[{cx, cy}] = kOccupied;
  }
}

/// Exact: whether the square of any occupied cell meets the footprint (separating axes of cell and
/// polygon).
bool overlaps(const OccupancyGrid& grid, const Footprint& footprint, const Pose2& pose) {
  const double half = 0.5 * grid.geometry.resolution;
  const double reach = footprint.circumscribed_radius() + 2.0 * half;
  const Pose2 to_base = pose.inverse();
  const Cell low = grid.geometry.cell_of(pose.position() - Eigen::Vector2d(reach, reach));
  const Cell high = grid.geometry.cell_of(pose.position() + Eigen::Vector2d(reach, reach));
  const double spread = half * (std::abs(std::cos(pose.yaw)) + std::abs(std::sin(pose.yaw)));
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (grid.at_or({x, y}, kOccupied) < kOccupied) continue;
      const Eigen::Vector2d middle = grid.geometry.center_of({x, y});
      const Eigen::Vector2d seen = to_base * middle;
      const bool apart_in_base =
          seen.x() - spread > footprint.upper().x() || seen.x() + spread < footprint.lower().x() ||
          seen.y() - spread > footprint.upper().y() || seen.y() + spread < footprint.lower().y();
      if (apart_in_base) continue;
      Eigen::Vector2d lower = pose * footprint.vertices().front();
      Eigen::Vector2d upper = lower;
      for (const Eigen::Vector2d& vertex : footprint.vertices()) {
        lower = lower.cwiseMin(pose * vertex);
        upper = upper.cwiseMax(pose * vertex);
      }
      const bool apart_in_grid = middle.x() - half > upper.x() || middle.x() + half < lower.x() ||
                                 middle.y() - half > upper.y() || middle.y() + half < lower.y();
      if (!apart_in_grid) return true;
    }
  }
  return false;
}

}  // namespace

OccupancyGrid make_duck_house() {
  OccupancyGrid house({280, 180, 0.05, {0.0, 0.0}}, kFree);
  fill(house, 0.0, 0.0, 14.0, 0.1);
  fill(house, 0.0, 8.9, 14.0, 0.1);
  fill(house, 0.0, 0.0, 0.1, 9.0);
  fill(house, 13.9, 0.0, 0.1, 9.0);
  for (const double x : {0.9, 3.6, 6.3, 9.0}) fill(house, x, 8.45, 2.1, 0.45);  // nest boxes, north
  for (const double x : {1.5, 5.0}) fill(house, x, 0.1, 2.4, 0.45);             // nest boxes, south
  fill(house, 13.45, 5.2, 0.45, 2.4);                                           // nest boxes, east
  for (const double x : {3.5, 7.0, 10.5}) {
    for (const double y : {3.0, 6.0}) fill(house, x, y, 0.15, 0.15);  // posts
  }
  fill(house, 5.0, 4.4, 1.2, 0.4);  // feeder
  fill(house, 9.6, 0.1, 0.1, 2.0);  // pen wall: the gate to its north is 1.6 m wide
  fill(house, 9.6, 3.7, 0.1, 0.8);
  return house;
}

TaskSource::TaskSource(const OccupancyGrid& house, const ExperimentRobot& robot)
    : house_(house),
      bare_(robot.footprint),
      goal_room_(robot.footprint, 0.03),
      start_room_(robot.footprint, 0.10) {
  std::vector<std::uint8_t> obstacles(house.cells.size());
  std::transform(house.cells.begin(), house.cells.end(), obstacles.begin(),
                 [](std::int8_t cell) { return cell >= kOccupied ? 1 : 0; });
  distances_.update(house.geometry, obstacles, 1.0);
}

EggTask TaskSource::draw(RandomStream& random) const {
  const double width = house_.geometry.width * house_.geometry.resolution;
  const double height = house_.geometry.height * house_.geometry.resolution;
  EggTask task;
  do {
    task.start = {random.uniform(0.0, width), random.uniform(0.0, height),
                  random.uniform(-std::numbers::pi, std::numbers::pi)};
  } while (overlaps(house_, start_room_, task.start));
  do {
    task.egg = {random.uniform(0.0, width), random.uniform(0.0, height)};
  } while (distances_.distance_at(task.egg) < 0.08 ||
           start_room_.contains(task.start.inverse() * task.egg) ||
           !goal_for(task.start, task.egg));
  return task;
}

std::optional<Pose2> TaskSource::goal_for(const Pose2& robot, const Eigen::Vector2d& egg,
                                          int skip) const {
  const Eigen::Vector2d towards = egg - robot.position();
  const double direct = std::atan2(towards.y(), towards.x());
  constexpr int kDirections = 36;
  for (int i = 0; i < kDirections; ++i) {
    const double turn =
        (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2) * 2.0 * std::numbers::pi / kDirections;
    const double yaw = normalize_angle(direct + turn);
    const Pose2 goal{egg.x() - kWorkingPoint.x() * std::cos(yaw),
                     egg.y() - kWorkingPoint.x() * std::sin(yaw), yaw};
    if (!overlaps(house_, goal_room_, goal) && skip-- == 0) return goal;
  }
  return std::nullopt;
}

bool TaskSource::collides(const Pose2& robot) const {
  return overlaps(house_, bare_, robot);
}

}  // namespace coop::test
