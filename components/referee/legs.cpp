#include "referee/legs.hpp"

#include <fmt/format.h>

#include <utility>

namespace coop::referee {

std::vector<std::string> leg_columns() {
  return {"seed", "leg",      "goal_x",      "goal_y",  "start_time", "end_time",
          "time", "straight", "path_length", "reached", "collisions"};
}

std::vector<std::string> to_row(const Leg& leg, std::uint64_t seed, int number) {
  const double start = to_seconds(leg.start);
  const double end = to_seconds(leg.end);
  return {std::to_string(seed),
          std::to_string(number),
          fmt::format("{:.3f}", leg.goal_in_map.x()),
          fmt::format("{:.3f}", leg.goal_in_map.y()),
          fmt::format("{:.2f}", start),
          fmt::format("{:.2f}", end),
          fmt::format("{:.2f}", end - start),
          fmt::format("{:.4f}", leg.straight),
          fmt::format("{:.4f}", leg.path_length),
          leg.reached ? "1" : "0",
          std::to_string(leg.collisions)};
}

void Legs::begin(const Pose2& map_in_world) {
  if (!map_in_world_) map_in_world_ = map_in_world;
}

void Legs::see(const world::GroundTruth& truth) {
  if (open_ && truth_ && !open_->reached) {
    open_->path_length += distance(truth_->robot_in_world, truth.robot_in_world);
    open_->end = truth.stamp;
    const Eigen::Vector2d goal = *map_in_world_ * open_->goal_in_map;
    open_->reached = (truth.robot_in_world.position() - goal).norm() < radius_;
  }
  truth_ = truth;
}

void Legs::hear_goal(const std::string& goal_id, const Eigen::Vector2d& goal_in_map) {
  if (goal_id == goal_id_ || !map_in_world_ || !truth_) return;
  end();
  goal_id_ = goal_id;
  const Eigen::Vector2d goal = *map_in_world_ * goal_in_map;
  open_.emplace();
  open_->goal_in_map = goal_in_map;
  open_->start = open_->end = truth_->stamp;
  open_->straight = (truth_->robot_in_world.position() - goal).norm();
  collisions_before_ = truth_->collision_count;
}

void Legs::end() {
  if (!open_) return;
  open_->collisions = truth_->collision_count - collisions_before_;
  finished_.push_back(*std::exchange(open_, std::nullopt));
}

std::vector<Leg> Legs::take_finished() {
  return std::exchange(finished_, {});
}

}  // namespace coop::referee
