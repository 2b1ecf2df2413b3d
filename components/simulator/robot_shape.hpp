#pragma once
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "core/pose.hpp"
#include "core/robot/robot_model.hpp"

namespace coop::simulator {

/// Where a wheel stands on the floor.
struct WheelPatch {
  Eigen::Vector2d center{0, 0};  ///< in base_link, m
  double half_length = 0.0;      ///< m, along the rolling direction
  double half_width = 0.0;       ///< m
  bool steered = false;
};

/// What the simulation knows of the robot's body.
struct RobotShape {
  std::vector<Eigen::Vector2d> footprint;  ///< convex, counter-clockwise, in base_link, m
  robot::AckermannGeometry base;
  std::vector<WheelPatch> wheels;
  Eigen::Vector2d working_point{
      0, 0};  ///< of the egg when it is picked, in base_link, m; of a robot with an arm
  /// Eggs released within it fall into the basket; in base_link, m; empty: it has none.
  Eigen::AlignedBox3d basket;
  /// The blade of a cleaning robot over the floor, in base_link, m; empty: it has none.
  Eigen::AlignedBox2d scraper;
  Pose3 imu_in_base = Pose3::Identity();
};

/// Throws config::Error where the description lacks one of them.
[[nodiscard]] RobotShape shape_of(const robot::RobotModel& model);

}  // namespace coop::simulator
