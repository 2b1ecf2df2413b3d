#include "global_planner/pose_checker.hpp"

#include <algorithm>
#include <cmath>

#include "core/costmap/footprint.hpp"

namespace coop::global_planner {

void PoseCheckerConfig::describe(config::Fields& fields) {
  fields.number(
      "padding", padding,
      {.unit = "m", .help = "free space around the footprint on the way", .min = 0, .max = 1});
  fields.number("tight_padding", tight_padding,
                {.unit = "m",
                 .help = "the same near a start or goal where the full padding does not fit",
                 .min = 0,
                 .max = 1});
  fields.number(
      "escape_padding", escape_padding,
      {.unit = "m",
       .help = "the same near a start that is blocked even so; negative: smaller than the robot",
       .min = -0.15,
       .max = 0});
  fields.number("tight_distance", tight_distance,
                {.unit = "m",
                 .help = "distance from start or goal within which its own padding holds",
                 .min = 0,
                 .max = 5});
}

PoseChecker::PoseChecker(const PoseCheckerConfig& config,
                         const std::vector<Eigen::Vector2d>& footprint, double resolution)
    : config_(config) {
  for (const double padding : {config.padding, config.tight_padding, config.escape_padding}) {
    checkers_.emplace_back(Footprint(footprint, padding), resolution);
  }
}

Result<void, PoseFailure> PoseChecker::prepare(const DistanceField& field, const Pose2& start,
                                               const Pose2& goal) {
  field_ = &field;
  start_ = start;
  goal_ = goal;
  start_level_ = kFull;
  while (start_level_ < checkers_.size() && checkers_[start_level_].collides(field, start)) {
    ++start_level_;
  }
  if (start_level_ == checkers_.size()) return fail(PoseFailure::kStartBlocked);
  goal_level_ = checkers_[kFull].collides(field, goal) ? kTight : kFull;
  if (!fits(field, goal)) return fail(PoseFailure::kGoalBlocked);
  return {};
}

bool PoseChecker::free(const CollisionChecker::Placement& at) const {
  if (!checkers_[kFull].collides(*field_, at)) return true;
  std::size_t level = kFull;
  const auto near = [&](const Pose2& pose) {
    return std::hypot(at.x - pose.x, at.y - pose.y) < config_.tight_distance;
  };
  if (near(start_)) level = start_level_;
  if (near(goal_)) level = std::max(level, goal_level_);
  return level != kFull && !checkers_[level].collides(*field_, at);
}

}  // namespace coop::global_planner
