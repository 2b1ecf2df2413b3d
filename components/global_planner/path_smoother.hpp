#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/pose.hpp"
#include "core/search/grid_planner.hpp"

namespace coop::global_planner {

/// Rounds off the corners of a grid path: every inner point moves towards the middle of its
/// neighbours and back to where it was, until nothing moves any more (gradient descent on the sum
/// of both squared distances). A point does not move to a cell that costs more than the one it is
/// in.
[[nodiscard]] std::vector<Eigen::Vector2d> smooth(const TraversalGrid& grid,
                                                  std::vector<Eigen::Vector2d> points);

/// Poses at equal distances along the points, each turned along the path; the last one has the
/// goal's heading.
[[nodiscard]] std::vector<Pose2> orient(const std::vector<Eigen::Vector2d>& points, double spacing,
                                        double goal_yaw);

}  // namespace coop::global_planner
