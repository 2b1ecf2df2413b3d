#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/costmap/distance_field.hpp"
#include "core/pose.hpp"
#include "dwa/config.hpp"
#include "dwa/prediction.hpp"

namespace coop::dwa {

/// The values of one admissible candidate before normalisation.
struct Evaluation {
  double head = 0.0;        ///< degrees, 0 to 180
  double dist = 0.0;        ///< m
  double velocity = 0.0;    ///< m/s
  double path_error = 0.0;  ///< mean squared error along the plan, m^2; not in the paper
};

/// head(v, w) = 180 degrees - theta: theta is the angle between the direction in which the robot
/// moves at the end of the trajectory and the direction from there to the target. `direction` is -1
/// for a robot that drives backwards.
[[nodiscard]] double head(const Pose2& end, const Eigen::Vector2d& target, int direction = 1);

/// dist(v, w): distance between the end of the trajectory and the nearest obstacle, m, up to
/// `limit`.
[[nodiscard]] double dist(const DistanceField& obstacles, const Pose2& end, double limit);

/// Equations (9) and (10) over all candidates:
///   nor_head_i = head_i / sum_k head_k   (dist and velocity alike; 0 for all where the sum is 0)
///   G_i = alpha nor_head_i + beta nor_dist_i + gamma nor_vel_i
/// and, with `path_weight` > 0, which the paper does not have:
///   G_i - (path_weight / n) path_error_i / path_scale^2
/// A normalised term is 1 / n on average, so the share of n keeps the weights in proportion for any
/// number n of candidates. Results in `scores`, same order.
void score(const CriticConfig& config, std::span<const Evaluation> candidates, double path_weight,
           std::vector<double>& scores);

}  // namespace coop::dwa
