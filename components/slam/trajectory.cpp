#include "slam/trajectory.hpp"

#include <algorithm>

namespace coop::slam {

std::vector<StampedPose2> interpolate_trajectory(std::span<const TrajectoryNode> nodes,
                                                 std::span<const StampedPose2> odometry) {
  std::vector<StampedPose2> trajectory;
  if (nodes.empty()) return trajectory;
  trajectory.reserve(odometry.size());
  std::size_t next = 0;
  for (const auto& [stamp, base_in_odom] : odometry) {
    while (next < nodes.size() && nodes[next].stamp <= stamp) ++next;
    const TrajectoryNode& before = nodes[next > 0 ? next - 1 : 0];
    const Pose2 forward = before.base_in_map * (before.base_in_odom.inverse() * base_in_odom);
    if (next == 0 || next == nodes.size()) {
      trajectory.push_back({stamp, forward});
      continue;
    }
    const TrajectoryNode& after = nodes[next];
    const Pose2 backward = after.base_in_map * (after.base_in_odom.inverse() * base_in_odom);
    const double ratio = to_seconds(stamp - before.stamp) / to_seconds(after.stamp - before.stamp);
    trajectory.push_back({stamp, interpolate(forward, backward, ratio)});
  }
  return trajectory;
}

}  // namespace coop::slam
