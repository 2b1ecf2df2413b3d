#include "system/map_log/recorded_drive.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/carmen/carmen_log.hpp"
#include "core/world/ray_caster.hpp"
#include "support/room.hpp"

namespace coop::test {
namespace {

constexpr double kSpeed = 0.5;   ///< m/s
constexpr double kRadius = 2.2;  ///< m
constexpr double kDrift = 1.02;  ///< distance told for distance driven
constexpr double kReach = 80.0;  ///< m
constexpr int kBeams = 181;
constexpr int kTenths = 300;  ///< of a second

world::World furnished_room() {
  world::World world = room(100, 80);
  const auto box = [&](int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) world.grid[{x, y}] = kOccupied;
    }
  };
  box(1, 60, 12, 81);
  box(80, 1, 101, 10);
  box(47, 38, 55, 44);
  box(88, 70, 95, 76);
  return world;
}

/// Goes round the middle of the room, counter-clockwise.
Pose2 robot_in_room(double time) {
  const double angle = kSpeed / kRadius * time;
  return {5.0 + kRadius * std::cos(angle), 4.0 + kRadius * std::sin(angle),
          normalize_angle(angle + std::numbers::pi / 2)};
}

std::vector<float> measure(const world::RayCaster& room, const Pose2& laser, double angle_min,
                           double increment) {
  std::vector<float> ranges;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = laser.yaw + angle_min + i * increment;
    const auto hit = room.cast(laser.position(), {std::cos(angle), std::sin(angle)}, kReach);
    ranges.push_back(static_cast<float>(hit ? hit->range : kReach));
  }
  return ranges;
}

}  // namespace

RecordedDrive record_drive(const std::filesystem::path& file) {
  RecordedDrive drive{file, {}, {}};
  const world::RayCaster room(furnished_room().grid);
  std::ofstream out(file);
  Pose2 robot_in_odom;
  for (int i = 0; i <= kTenths; ++i) {
    const Pose2 robot = robot_in_room(0.1 * i);
    const Time stamp = time_from_seconds(976052890.0) + std::chrono::milliseconds(100 * i);
    if (i > 0) {
      Pose2 step = robot_in_room(0.1 * (i - 1)).inverse() * robot;
      step.x *= kDrift;
      robot_in_odom = robot_in_odom * step;
    }
    drive.odometry.insert(stamp);
    out << carmen::to_line(carmen::OdometryRecord{
        .stamp = stamp, .robot_in_odom = robot_in_odom, .v = kSpeed, .omega = kSpeed / kRadius});
    if (i % 2 != 0) continue;
    carmen::LaserRecord laser;
    laser.stamp = stamp + std::chrono::milliseconds(40);
    laser.angle_min = -std::numbers::pi / 2;
    laser.angle_increment = std::numbers::pi / 180;
    laser.range_max = kReach;
    laser.laser_in_odom = laser.robot_in_odom = robot_in_odom;
    laser.ranges = measure(room, robot, laser.angle_min, laser.angle_increment);
    drive.odometry.insert(laser.stamp);
    drive.scans.insert(laser.stamp);
    out << carmen::to_line(laser);
  }
  return drive;
}

}  // namespace coop::test
