#include "dwa/trajectory_chooser.hpp"

#include <algorithm>
#include <cmath>

#include "core/costmap/footprint.hpp"

namespace coop::dwa {
namespace {

constexpr double kStandstill = 1e-3;      ///< m/s
constexpr double kPursuitDistance = 0.4;  ///< m
constexpr double kEscapePadding = -0.05;  ///< m: smaller than the robot, see checkers_

/// The steering angle of the circle that leads from base_link to the point.
double pursuit_steering(const vehicle::AckermannGeometry& base, const Pose2& robot,
                        const Pose2& point) {
  const Pose2 seen = robot.inverse() * point;
  const double squared = seen.x * seen.x + seen.y * seen.y;
  return squared > 0.0 ? vehicle::steering_of_curvature(base, 2.0 * seen.y / squared) : 0.0;
}

}  // namespace

TrajectoryChooser::TrajectoryChooser(const DwaConfig& config,
                                     const std::vector<Eigen::Vector2d>& footprint,
                                     const vehicle::AckermannGeometry& base, double steering_rate)
    : config_(config),
      base_(base),
      limits_{config.speed.acceleration, steering_rate},
      window_(config.window, config.speed.acceleration, base, steering_rate) {
  for (const double padding : {config.prediction.padding, 0.0, kEscapePadding}) {
    checkers_.emplace_back(Footprint(footprint, padding), config.local_map.resolution);
  }
}

const Candidate* TrajectoryChooser::choose(const Situation& situation) {
  sample(situation);
  admissible_.clear();
  evaluations_.clear();
  const CollisionChecker* checker = checker_at(situation);
  for (std::size_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    predict(situation, candidate);
    candidate.admissible = is_free(situation, checker, candidate.trajectory);
    if (!candidate.admissible) continue;
    admissible_.push_back(i);
    evaluations_.push_back(evaluate(situation, candidate));
  }
  const double path_weight = config_.paper() ? 0.0 : config_.critic.path_weight;
  score(config_.critic, evaluations_, path_weight, scores_);
  const Candidate* best = nullptr;
  for (std::size_t k = 0; k < admissible_.size(); ++k) {
    Candidate& candidate = candidates_[admissible_[k]];
    candidate.score = scores_[k];
    if (best == nullptr || candidate.score > best->score) best = &candidate;
  }
  return best;
}

bool TrajectoryChooser::is_free(const Situation& situation, const CollisionChecker* checker,
                                const Trajectory& trajectory) {
  if (checker == nullptr) return false;
  const auto collides = [&](const Pose2& pose) {
    return checker->collides(*situation.obstacles, pose);
  };
  if (std::ranges::any_of(trajectory, collides)) return false;
  return situation.animals == nullptr || !situation.animals->collides(trajectory);
}

void TrajectoryChooser::sample(const Situation& situation) {
  double low = situation.min_speed;
  double high = situation.max_speed;
  if (situation.direction < 0) {
    low = -situation.max_speed;
    high = -situation.min_speed;
  }
  const auto ahead = static_cast<std::size_t>(kPursuitDistance / kPathSpacing);
  const double wish = situation.path.size() > ahead
                          ? pursuit_steering(base_, situation.base, situation.path[ahead])
                          : situation.motion.steering;
  window_.sample(situation.motion, low, high, wish, commands_);
  if (candidates_.size() < commands_.size()) candidates_.resize(commands_.size());
  count_ = 0;
  for (const Command& command : commands_) {
    // Standing still is not a way to get on; it is what is left when nothing is admissible.
    if (std::abs(command.speed) > kStandstill) candidates_[count_++].command = command;
  }
}

void TrajectoryChooser::predict(const Situation& situation, Candidate& candidate) const {
  if (config_.paper()) {
    predict_as_paper(config_.prediction, situation.base,
                     vehicle::twist_of(base_, candidate.command.speed, candidate.command.steering),
                     candidate.trajectory);
  } else {
    predict_ramped(config_.prediction, base_, limits_, situation.base, situation.motion,
                   candidate.command, situation.max_distance, candidate.trajectory);
  }
}

const CollisionChecker* TrajectoryChooser::checker_at(const Situation& situation) const {
  for (const CollisionChecker& checker : checkers_) {
    if (!checker.collides(*situation.obstacles, situation.base)) return &checker;
  }
  return nullptr;
}

Evaluation TrajectoryChooser::evaluate(const Situation& situation,
                                       const Candidate& candidate) const {
  Evaluation evaluation;
  const Pose2& end = candidate.trajectory.back();
  evaluation.head = head(end, situation.target, situation.direction);
  evaluation.dist = dist(*situation.obstacles, end, config_.critic.max_obstacle_distance);
  evaluation.velocity = std::abs(candidate.command.speed);
  if (!config_.paper()) evaluation.path_error = path_error(situation, candidate.command);
  return evaluation;
}

double TrajectoryChooser::path_error(const Situation& situation, const Command& command) const {
  const double turn_per_step =
      limits_.steering_rate * kPathSpacing / std::max(std::abs(command.speed), kStandstill);
  double steering = situation.motion.steering;
  Pose2 pose = situation.base;
  double sum = 0.0;
  for (const Pose2& wanted : situation.path) {
    const double next =
        steering + std::clamp(command.steering - steering, -turn_per_step, turn_per_step);
    const double step = situation.direction * kPathSpacing;
    const double curvature = vehicle::curvature_of(base_, 0.5 * (steering + next));
    pose = vehicle::advance_along_arc(pose, step, step * curvature);
    steering = next;
    const double dx = pose.x - wanted.x;
    const double dy = pose.y - wanted.y;
    const double beside = -std::sin(wanted.yaw) * dx + std::cos(wanted.yaw) * dy;
    const double turned = config_.critic.heading_arm * angle_difference(pose.yaw, wanted.yaw);
    sum += beside * beside + turned * turned;
  }
  return situation.path.empty() ? 0.0 : sum / static_cast<double>(situation.path.size());
}

}  // namespace coop::dwa
