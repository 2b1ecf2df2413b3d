#include "referee/referee.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "referee/judgement.hpp"

namespace coop::referee {

void RefereeConfig::describe(config::Fields& fields) {
  fields.number("same_egg", same_egg,
                {.unit = "m",
                 .help = "an egg of the mission farther from every true one is false",
                 .min = 0,
                 .max = 10});
  fields.number("standing_speed", standing_speed,
                {.unit = "m/s", .help = "slower is standing", .min = 0, .max = 1});
  fields.number("range_along", range.along,
                {.unit = "m", .help = "working range along the heading", .min = 0.001, .max = 1});
  fields.number("range_across", range.across,
                {.unit = "m", .help = "working range across the heading", .min = 0.001, .max = 1});
}

Referee::Referee(const RefereeConfig& config, const Eigen::Vector2d& working_point)
    : config_(config), working_point_(working_point) {}

void Referee::begin(const world::World& world) {
  if (map_in_world_) return;
  map_in_world_ = world.robot_start;
  if (!has_truth_) truth_.eggs = world.eggs;
}

void Referee::see(const world::GroundTruth& truth) {
  if (open_ && has_truth_ && !open_->arrived) {
    open_->attempt.path_length += distance(truth_.robot_in_world, truth.robot_in_world);
  }
  truth_ = truth;
  has_truth_ = true;
}

void Referee::locate(Time stamp, const Pose2& robot_in_world, const Pose2& believed_in_map) {
  located_ = {stamp, robot_in_world, believed_in_map};
  if (!open_ || !open_->arrived || open_->attempt.arrival || stamp < *open_->arrived) return;
  if (std::abs(truth_.velocity.v) < config_.standing_speed) judge_arrival();
}

void Referee::hear_goal(const std::string& goal_id) {
  goal_id_ = goal_id;
  if (!open_ || open_->arrived || open_->goal_id.empty()) return;
  // Another side of the same egg, after a goal that was refused.
  open_->goal_id = goal_id;
  open_->given_up_by.reset();
}

void Referee::hear(const NavigationView& navigation) {
  if (!open_ || navigation.goal_id != open_->goal_id || open_->arrived) return;
  switch (navigation.state) {
    case NavigationView::State::kArrived:
      if (navigation.source == NavigationView::Source::kDriver) open_->arrived = truth_.stamp;
      break;
    case NavigationView::State::kFailed:
      open_->given_up_by = navigation.source;
      break;
    case NavigationView::State::kUnderWay:
      // A navigator that waited for a sensor or a person goes on.
      if (open_->given_up_by == navigation.source) open_->given_up_by.reset();
      break;
  }
}

void Referee::hear(const MissionView& mission) {
  if (ended_) return;
  mission_ = mission;
  // What ends comes before what begins.
  for (const MissionEgg& egg : mission.eggs) {
    if (open_ && egg.id == open_->attempt.mission_egg) follow(egg);
  }
  for (const MissionEgg& egg : mission.eggs) {
    auto seen = std::ranges::find(tries_seen_, egg.id, &std::pair<std::string, int>::first);
    if (seen == tries_seen_.end()) seen = tries_seen_.insert(seen, {egg.id, 0});
    if (egg.tries <= seen->second) continue;
    seen->second = egg.tries;
    open(egg);
    follow(egg);
  }
  if (mission.ended) end();
}

void Referee::open(const MissionEgg& egg) {
  if (open_) close("", true);
  Open attempt;
  attempt.attempt.mission_egg = egg.id;
  attempt.attempt.try_number = egg.tries;
  attempt.attempt.start = truth_.stamp;
  attempt.attempt.egg = nearest_egg(egg.egg_in_map);
  attempt.collisions_before = truth_.collision_count;
  attempt.believed_egg_in_map = egg.egg_in_map;
  // Where no goal was set, no later word of a navigator is about this attempt.
  if (egg.phase == MissionEgg::Phase::kApproaching) attempt.goal_id = goal_id_;
  open_ = std::move(attempt);
}

/// The mission's latest word on the egg of the open attempt.
void Referee::follow(const MissionEgg& egg) {
  open_->believed_egg_in_map = egg.egg_in_map;
  const bool goes_on =
      egg.tries == open_->attempt.try_number &&
      (egg.phase == MissionEgg::Phase::kApproaching || egg.phase == MissionEgg::Phase::kPicking);
  // The driver's word may have been overtaken by the mission's.
  if (egg.phase == MissionEgg::Phase::kPicking && !open_->arrived) open_->arrived = truth_.stamp;
  if (!goes_on) close(egg.reason, true);
}

void Referee::judge_arrival() {
  Attempt& attempt = open_->attempt;
  const world::Egg* egg = true_egg(attempt.egg);
  if (egg == nullptr || !located_ || !map_in_world_ || egg->state != world::EggState::kOnFloor) {
    return;
  }
  const Pose2 world_in_map = map_in_world_->inverse();
  attempt.arrival = analyse({.stamp = located_->stamp,
                             .robot_in_map = world_in_map * located_->robot_in_world,
                             .believed_robot_in_map = located_->believed_in_map,
                             .egg_in_map = world_in_map * Eigen::Vector2d(egg->position.head<2>()),
                             .believed_egg_in_map = open_->believed_egg_in_map},
                            working_point_);
  attempt.in_range = config_.range.contains(attempt.arrival->deviation);
}

void Referee::close(const std::string& reason, bool mission_goes_on) {
  if (open_->arrived && !open_->attempt.arrival) judge_arrival();
  Attempt& attempt = open_->attempt;
  attempt.end = truth_.stamp;
  attempt.collisions = truth_.collision_count - open_->collisions_before;
  const world::Egg* egg = true_egg(attempt.egg);
  attempt.picked = egg != nullptr && egg->state == world::EggState::kCollected;
  attempt.detail = attempt.picked ? "" : reason;
  attempt.cause = cause_of(*open_, mission_goes_on);
  if (!attempt.egg.empty()) eggs_tried_.push_back(attempt.egg);
  finished_.push_back(std::move(attempt));
  open_.reset();
}

Cause Referee::cause_of(const Open& open, bool mission_goes_on) const {
  const Attempt& attempt = open.attempt;
  if (attempt.in_range) return Cause::kNone;
  if (attempt.egg.empty()) return Cause::kFalseEgg;
  if (attempt.arrival) return cause_of_miss(*attempt.arrival, config_.range);
  const world::Egg* egg = true_egg(attempt.egg);
  if (egg != nullptr && egg->state == world::EggState::kBroken) return Cause::kEggBroken;
  if (open.goal_id.empty()) return Cause::kNoFreePose;
  if (attempt.collisions > 0) return Cause::kCollision;
  if (open.given_up_by == NavigationView::Source::kPlanner) return Cause::kNoPath;
  if (open.given_up_by == NavigationView::Source::kDriver) return Cause::kDriverGaveUp;
  return mission_goes_on ? Cause::kTimedOut : Cause::kMissionEnded;
}

const world::Egg* Referee::true_egg(const std::string& id) const {
  const auto found = std::ranges::find(truth_.eggs, id, &world::Egg::id);
  return found == truth_.eggs.end() ? nullptr : &*found;
}

std::string Referee::nearest_egg(const Eigen::Vector2d& egg_in_map) const {
  if (!map_in_world_) return {};
  const Eigen::Vector2d believed = *map_in_world_ * egg_in_map;
  double best = config_.same_egg;
  std::string id;
  for (const world::Egg& egg : truth_.eggs) {
    if (egg.state == world::EggState::kCollected || egg.state == world::EggState::kInGripper) {
      continue;
    }
    const double apart = (egg.position.head<2>() - believed).norm();
    if (apart >= best) continue;
    best = apart;
    id = egg.id;
  }
  return id;
}

Attempt Referee::untried(const world::Egg& egg) const {
  Attempt attempt;
  attempt.egg = egg.id;
  attempt.start = truth_.stamp;
  attempt.end = truth_.stamp;
  attempt.cause = egg.state == world::EggState::kBroken ? Cause::kEggBroken : Cause::kNotSeen;
  for (const MissionEgg& known : mission_.eggs) {
    if (nearest_egg(known.egg_in_map) != egg.id) continue;
    attempt.mission_egg = known.id;
    attempt.detail = known.reason;
    if (attempt.cause == Cause::kNotSeen) attempt.cause = Cause::kNotTried;
  }
  return attempt;
}

void Referee::end() {
  if (ended_) return;
  ended_ = true;
  if (open_) close("", false);
  for (const world::Egg& egg : truth_.eggs) {
    if (std::ranges::find(eggs_tried_, egg.id) == eggs_tried_.end()) {
      finished_.push_back(untried(egg));
    }
  }
}

std::vector<Attempt> Referee::take_finished() {
  return std::exchange(finished_, {});
}

}  // namespace coop::referee
