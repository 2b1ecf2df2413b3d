#pragma once
#include <cmath>
#include <limits>
#include <numbers>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"
#include "core/scan.hpp"
#include "core/vehicle/ackermann.hpp"
#include "core/world/ray_caster.hpp"

namespace coop::test {

/// A barn of 14 m x 9 m without symmetry: nest boxes along two walls, four posts, one partition. In
/// cells of 1 cm.
inline OccupancyGrid barn() {
  OccupancyGrid world({1500, 1000, 0.01, {-0.5, -0.5}}, kUnknown);
  const auto fill = [&](double x0, double y0, double x1, double y1, std::int8_t value) {
    const Cell from = world.geometry.cell_of({x0 + 1e-6, y0 + 1e-6});
    const Cell to = world.geometry.cell_of({x1 - 1e-6, y1 - 1e-6});
    for (int y = from.y; y <= to.y; ++y) {
      for (int x = from.x; x <= to.x; ++x) world[{x, y}] = value;
    }
  };
  fill(0, 0, 14, 9, kOccupied);
  fill(0.1, 0.1, 13.9, 8.9, kFree);
  fill(0.1, 0.1, 0.6, 4.1, kOccupied);   // nest boxes on the left
  fill(6.0, 8.4, 11.5, 8.9, kOccupied);  // nest boxes at the back
  fill(9.0, 0.1, 9.1, 3.0, kOccupied);   // partition
  for (const auto& [x, y] : {std::pair{4.0, 3.0}, {4.0, 6.0}, {8.0, 5.0}, {11.5, 6.2}}) {
    fill(x - 0.1, y - 0.1, x + 0.1, y + 0.1, kOccupied);
  }
  return world;
}

/// The map a laser would leave of a world: cells of 5 cm, not aligned with the walls; occupied
/// where a face is seen, free where beams pass, unknown inside of things and beyond the walls.
inline OccupancyGrid mapped(const OccupancyGrid& world) {
  const GridGeometry& fine = world.geometry;
  OccupancyGrid map({299, 199, 0.05, fine.origin + Eigen::Vector2d{0.013, 0.031}}, kUnknown);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const Cell cell = map.geometry.cell_of(fine.center_of({x, y}));
      if (!map.geometry.contains(cell)) continue;
      if (world[{x, y}] == kFree && map[cell] == kUnknown) map[cell] = kFree;
      if (world[{x, y}] != kOccupied) continue;
      for (const Cell next : {Cell{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
        if (world.at_or(next, kUnknown) == kFree) map[cell] = kOccupied;
      }
    }
  }
  return map;
}

/// A car that drives in a map, its laser and its drifting odometry.
class SimulatedDrive {
 public:
  SimulatedDrive(const OccupancyGrid& map, const Pose2& start, std::uint64_t seed)
      : caster_(map), random_(seed, "simulated drive"), base_in_map(start) {}

  /// One step at speed v (m/s) and turn rate omega (rad/s).
  void drive(double v, double omega, double dt = 0.1) {
    base_in_map = vehicle::advance_along_arc(base_in_map, v * dt, omega * dt);
    const double way = std::sqrt(std::abs(v) * dt);
    const double turn = std::sqrt(std::abs(omega) * dt);
    base_in_odom = vehicle::advance_along_arc(
        base_in_odom, 1.01 * v * dt + 0.01 * way * random_.normal(),
        omega * dt + 0.01 * way * random_.normal() + 0.03 * turn * random_.normal());
    stamp += seconds(dt);
  }
  void wait(double dt = 0.1) { stamp += seconds(dt); }

  /// 270 degrees in 360 beams, 1 cm of noise; one beam in `clutter` ends short of the wall.
  [[nodiscard]] LaserScan scan(int clutter = 20) {
    LaserScan result;
    result.stamp = stamp;
    result.frame_id = "laser_link";
    result.angle_increment = static_cast<float>(1.5 * std::numbers::pi / 359.0);
    result.angle_min = static_cast<float>(-0.75 * std::numbers::pi);
    result.range_min = 0.05F;
    result.range_max = 12.0F;
    const Pose2 laser_in_map = base_in_map * laser_in_base;
    for (std::size_t i = 0; i < 360; ++i) {
      const double angle = laser_in_map.yaw + static_cast<double>(result.angle(i));
      const auto hit =
          caster_.cast(laser_in_map.position(), {std::cos(angle), std::sin(angle)}, 12.0);
      double range =
          hit ? hit->range + random_.normal(0.0, 0.01) : std::numeric_limits<double>::infinity();
      if (clutter > 0 && random_.below(static_cast<std::uint64_t>(clutter)) == 0)
        range *= random_.uniform(0.3, 1.0);
      result.ranges.push_back(static_cast<float>(range));
    }
    return result;
  }

  /// A tour through the barn that keeps off the walls, steering to waypoints.
  void follow_tour() {
    static constexpr double kTour[][2] = {{2, 1.5},  {7, 1.5}, {7, 4},   {12, 4},  {12, 2},
                                          {10.3, 4}, {10, 7},  {6, 6.8}, {2, 7.5}, {2, 4.5}};
    const Eigen::Vector2d target{kTour[leg_][0], kTour[leg_][1]};
    const Eigen::Vector2d way = target - base_in_map.position();
    if (way.norm() < 0.6) leg_ = (leg_ + 1) % std::size(kTour);
    const double error = angle_difference(std::atan2(way.y(), way.x()), base_in_map.yaw);
    drive(0.5, std::clamp(1.5 * error, -0.6, 0.6));
  }

 private:
  world::RayCaster caster_;
  RandomStream random_;
  std::size_t leg_ = 0;

 public:
  Pose2 base_in_map;
  Pose2 base_in_odom{100.0, -50.0, 2.0};  ///< odometry starts anywhere
  Pose2 laser_in_base{0.6, 0.0, 0.0};
  Time stamp = time_from_seconds(1000.0);
};

}  // namespace coop::test
