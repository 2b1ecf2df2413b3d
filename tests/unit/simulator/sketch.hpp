#pragma once
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "simulator/robot_shape.hpp"
#include "simulator/simulation.hpp"

namespace coop::simulator::test {

/// A grid drawn as text, first line on top: '#' occupied, '.' free, '?' unknown.
inline OccupancyGrid draw(const std::vector<std::string>& lines, double resolution,
                          const Eigen::Vector2d& origin = {0, 0}) {
  const int height = static_cast<int>(lines.size());
  const int width = static_cast<int>(lines.front().size());
  OccupancyGrid grid({width, height, resolution, origin}, kFree);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = lines[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      grid[{x, y}] = c == '#' ? kOccupied : c == '?' ? kUnknown : kFree;
    }
  }
  return grid;
}

/// A walled room from (0, 0) to (width, height), walls of 0.1 m outside it.
inline OccupancyGrid room(double width, double height) {
  constexpr double kCell = 0.05;
  const int columns = static_cast<int>(width / kCell + 0.5) + 4;
  const int rows = static_cast<int>(height / kCell + 0.5) + 4;
  OccupancyGrid grid({columns, rows, kCell, {-2 * kCell, -2 * kCell}}, kOccupied);
  for (int y = 2; y < rows - 2; ++y) {
    for (int x = 2; x < columns - 2; ++x) grid[{x, y}] = kFree;
  }
  return grid;
}

/// A robot of round numbers: 0.5 m wheelbase, 0.4 m track, nose at 0.7 m, tail at -0.2 m, 0.5 m
/// wide.
inline RobotShape robot() {
  RobotShape shape;
  shape.footprint = {{-0.2, -0.25}, {0.7, -0.25}, {0.7, 0.25}, {-0.2, 0.25}};
  shape.base = {.wheelbase = 0.5,
                .track = 0.4,
                .wheel_radius = 0.1,
                .max_steering_angle = 0.6,
                .max_steering_rate = 0.8};
  shape.wheels = {{{0.0, 0.2}, 0.03, 0.03, false},
                  {{0.0, -0.2}, 0.03, 0.03, false},
                  {{0.5, 0.2}, 0.03, 0.03, true},
                  {{0.5, -0.2}, 0.03, 0.03, true}};
  shape.working_point = {0.85, 0.0};
  shape.basket = {Eigen::Vector3d(-0.1, 0.0, 0.2), Eigen::Vector3d(0.1, 0.2, 0.6)};
  return shape;
}

/// No slip, no noise, no lag, no bias: what kinematics alone says.
inline SimulationConfig ideal() {
  SimulationConfig config;
  config.vehicle.speed_time_constant = 0.0;
  config.vehicle.steering_time_constant = 0.0;
  config.vehicle.slip = {.left = 0, .right = 0, .random = 0, .yaw_share = 0};
  config.wheel_sensor.left_scale = 1.0;
  config.wheel_sensor.right_scale = 1.0;
  config.wheel_sensor.steering_bias = 0.0;
  config.wheel_sensor.steering_noise = 0.0;
  config.imu = {.gyro_noise = 0, .gyro_bias = 0, .accel_noise = 0, .accel_bias = 0};
  return config;
}

inline world::World world_in(const OccupancyGrid& grid, const Pose2& start,
                             std::uint64_t seed = 1) {
  world::World world;
  world.grid = grid;
  world.robot_start = start;
  world.seed = seed;
  return world;
}

}  // namespace coop::simulator::test
