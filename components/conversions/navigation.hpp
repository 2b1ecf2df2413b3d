#pragma once
#include <nav_msgs/msg/OccupancyGrid.h>
#include <nav_msgs/msg/Odometry.h>
#include <nav_msgs/msg/Path.h>

#include <optional>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "core/odometry.hpp"
#include "core/pose.hpp"
#include "core/result.hpp"
#include "core/stamped.hpp"

namespace coop::conversions {

/// Odometry and the frames it speaks of.
struct FramedOdometry {
  Odometry odometry;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y, yaw; zero: unknown
  std::string frame_id = "odom";
  std::string child_frame_id = "base_link";
};
[[nodiscard]] nav_msgs::msg::Odometry to_msg(const FramedOdometry& odometry);
/// Refused: numbers that are not finite, a quaternion that is none, a covariance that is none.
[[nodiscard]] Result<FramedOdometry> from_msg(const nav_msgs::msg::Odometry& message);

/// Of the greatest map that is taken in, cells; a barn of 500 m x 500 m at 5 cm has 10^8.
inline constexpr std::size_t kMaxGridCells = std::size_t{1} << 28;

/// The resolution is a float on the wire; it comes back as the double with the same shortest
/// decimal notation, so that 0.05 m stays 0.05 m and cell borders agree in all programs.
[[nodiscard]] nav_msgs::msg::OccupancyGrid to_msg(const Stamped<OccupancyGrid>& grid);
/// Refused: a number of cells that is not width x height, no cells or more than kMaxGridCells, a
/// resolution that is not positive, a rotated or unset origin, values other than -1 to 100.
[[nodiscard]] Result<Stamped<OccupancyGrid>> from_msg(const nav_msgs::msg::OccupancyGrid& message);

/// All poses get the path's stamp and frame.
[[nodiscard]] nav_msgs::msg::Path to_path_msg(const Stamped<std::vector<Pose2>>& path);
/// Refused: a pose in a frame other than the path's (an empty name stands for the path's).
[[nodiscard]] Result<Stamped<std::vector<Pose2>>> from_msg(const nav_msgs::msg::Path& message);

}  // namespace coop::conversions
