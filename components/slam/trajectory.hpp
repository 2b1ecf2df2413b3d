#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/odometry.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

namespace coop::slam {

/// Where the robot was when a scan was taken: as odometry and as the map say.
struct TrajectoryNode {
  Time stamp{};
  Pose2 base_in_odom;
  Pose2 base_in_map;
};

/// Poses in the map at the stamps of `odometry` (ascending), for the way through `nodes`
/// (ascending). Between two nodes the odometry's shape is kept and what it misses at the second
/// node is spread over the time between; before the first and after the last node odometry goes on
/// from that node.
[[nodiscard]] std::vector<StampedPose2> interpolate_trajectory(
    std::span<const TrajectoryNode> nodes, std::span<const StampedPose2> odometry);

}  // namespace coop::slam
