#include "dwa/critic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coop::dwa {

double head(const Pose2& end, const Eigen::Vector2d& target, int direction) {
  const Eigen::Vector2d to_target = target - end.position();
  const double moving = direction < 0 ? end.yaw + std::numbers::pi : end.yaw;
  const double theta = angle_difference(std::atan2(to_target.y(), to_target.x()), moving);
  return 180.0 - std::abs(theta) * 180.0 / std::numbers::pi;
}

double dist(const DistanceField& obstacles, const Pose2& end, double limit) {
  return std::min(limit, obstacles.distance_at(end.position()));
}

void score(const CriticConfig& config, std::span<const Evaluation> candidates, double path_weight,
           std::vector<double>& scores) {
  Evaluation sum;
  for (const Evaluation& candidate : candidates) {
    sum.head += candidate.head;
    sum.dist += candidate.dist;
    sum.velocity += candidate.velocity;
  }
  const auto normalised = [](double value, double total) {
    return total > 0.0 ? value / total : 0.0;
  };
  const double path_factor = candidates.empty()
                                 ? 0.0
                                 : path_weight / static_cast<double>(candidates.size()) /
                                       (config.path_scale * config.path_scale);
  scores.clear();
  for (const Evaluation& candidate : candidates) {
    scores.push_back(config.alpha * normalised(candidate.head, sum.head) +
                     config.beta * normalised(candidate.dist, sum.dist) +
                     config.gamma * normalised(candidate.velocity, sum.velocity) -
                     path_factor * candidate.path_error);
  }
}

}  // namespace coop::dwa
