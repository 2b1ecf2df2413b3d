#include "global_planner/path_smoother.hpp"

#include <cmath>

namespace coop::global_planner {
namespace {

constexpr double kDataWeight = 0.1;
constexpr double kSmoothWeight = 0.4;
constexpr int kMaxRounds = 200;

}  // namespace

std::vector<Eigen::Vector2d> smooth(const TraversalGrid& grid,
                                    std::vector<Eigen::Vector2d> points) {
  const std::vector<Eigen::Vector2d> original = points;
  const auto factor_at = [&grid](const Eigen::Vector2d& point) {
    const Cell cell = grid.geometry().cell_of(point);
    return grid.geometry().contains(cell) ? grid.factor(grid.padded_index(cell))
                                          : TraversalGrid::kBlocked;
  };
  const double still = 1e-3 * grid.geometry().resolution;
  for (int round = 0; round < kMaxRounds; ++round) {
    double largest_move = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Eigen::Vector2d bend = points[i - 1] + points[i + 1] - 2.0 * points[i];
      const Eigen::Vector2d moved =
          points[i] + kDataWeight * (original[i] - points[i]) + kSmoothWeight * bend;
      if (factor_at(moved) > factor_at(points[i])) continue;
      largest_move = std::max(largest_move, (moved - points[i]).norm());
      points[i] = moved;
    }
    if (largest_move < still) break;
  }
  return points;
}

std::vector<Pose2> orient(const std::vector<Eigen::Vector2d>& points, double spacing,
                          double goal_yaw) {
  std::vector<Pose2> poses;
  double yaw = goal_yaw;
  double carried = 0.0;  // m since the last pose
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d step = points[i + 1] - points[i];
    const double length = step.norm();
    if (length <= 0.0) continue;
    yaw = std::atan2(step.y(), step.x());
    double along = poses.empty() ? 0.0 : spacing - carried;
    for (; along < length; along += spacing) {
      const Eigen::Vector2d at = points[i] + step * (along / length);
      poses.push_back({at.x(), at.y(), yaw});
    }
    carried = length - (along - spacing);
  }
  if (!points.empty()) {
    if (poses.size() > 1 && carried < 0.5 * spacing) poses.pop_back();
    poses.push_back({points.back().x(), points.back().y(), goal_yaw});
  }
  return poses;
}

}  // namespace coop::global_planner
