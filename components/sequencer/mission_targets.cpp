#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_set>

#include "sequencer/mission_rules.hpp"

// The part of the mission that is about its targets, eggs or heaps of manure: order and approach.
namespace coop::sequencer {
namespace {

/// m: a robot this far from where it was told to go has begun to drive there; one that still rolls
/// from the drive before has not.
constexpr double kMoved = 0.3;

}  // namespace

/// Confirmed tracks become eggs of the mission; positions follow the tracks until the pick.
void Mission::adopt_eggs(const MissionSnapshot& snapshot) {
  if (rules().target.empty() || snapshot.tracks == nullptr) return;
  std::size_t after = 0;  // eggs stand in the order of their tracks, but for a few
  for (const EggTrack& track : *snapshot.tracks) {
    if (!track.confirmed || track.picked) continue;
    EggTask* egg = state_.find_egg(track.id, after);
    if (egg != nullptr) after = static_cast<std::size_t>(egg - state_.eggs.data()) + 1;
    if (egg == nullptr) {
      EggTask& fresh = state_.eggs.emplace_back();
      fresh.id = track.id;
      fresh.egg_in_map = track.egg_in_map;
      changed_ = true;
      // Seen on the way to another: the order is made anew when that one is done.
      continue;
    }
    if (egg->phase == EggPhase::kPicking || egg->phase == EggPhase::kPicked) continue;
    egg->egg_in_map = track.egg_in_map;
    if (egg->unseen == 0 || track.seen_in_row < config_.seen_again_after) continue;
    // Thought missing, and there again. Approaches are not given anew: what is seen only from afar
    // must not hold the mission for ever.
    egg->unseen = 0;
    changed_ = true;
    if (egg->phase == EggPhase::kMissing && egg->attempts < config_.max_attempts) {
      egg->phase = EggPhase::kSeen;
    }
  }
}

void Mission::step_ordering(const MissionSnapshot& snapshot, const MapQueries& queries, Time now) {
  std::vector<const EggTask*> open;
  std::vector<const EggTask*> put_off;  // later: whoever was in the way may have gone by then
  for (const EggTask& egg : state_.eggs) {
    if (egg.phase == EggPhase::kPicked || egg.phase == EggPhase::kFailed ||
        egg.phase == EggPhase::kMissing) {
      continue;
    }
    (rules().is_put_off(egg) ? put_off : open).push_back(&egg);
  }
  state_.current_egg.clear();
  if (!open.empty()) waiting_since_.reset();
  if (open.empty() && (this->*rules().waits)(put_off, now)) return take_goal_back(now);
  if (open.empty()) open.swap(put_off);
  if (open.empty()) return (this->*rules().nothing_left)(now);
  last_look_.reset();
  const OrderedEggs ordered = queries.order(*snapshot.robot_in_map, open);
  if (ordered.order.empty()) return take_goal_back(now);  // no map yet
  const std::unordered_set<std::string_view> queued(ordered.order.begin(), ordered.order.end());
  std::unordered_set<std::string_view> picked;
  for (EggTask& egg : state_.eggs) {
    if (queued.contains(egg.id)) egg.phase = EggPhase::kQueued;
    if (egg.phase == EggPhase::kPicked) picked.insert(egg.id);
  }
  // What was picked stays in front: the order tells the whole tour.
  std::erase_if(state_.order, [&](const std::string& id) { return !picked.contains(id); });
  if (state_.order.empty()) {
    state_.tour_cost = ordered.cost;
    state_.tour_cost_alternative = ordered.alternative_cost;
  }
  state_.order.insert(state_.order.end(), ordered.order.begin(), ordered.order.end());
  for (const EggTask* egg : put_off) state_.order.push_back(egg->id);
  state_.current_egg = ordered.order.front();
  arrived_.reset();
  refusals_ = 0;
  changed_ = true;
  enter(MissionPhase::kDriving, "to " + state_.current_egg);
}

void Mission::begin_approach(const MissionSnapshot& snapshot, const MapQueries& queries, Time now) {
  EggTask& egg = *state_.find_egg(state_.current_egg);
  auto pose =
      choose_approach(*snapshot.robot_in_map, egg.egg_in_map, approach_, queries.pose_cost,
                      egg.tried_headings, egg.unseen > 0 ? config_.look_apart : kAttemptsApart);
  if (!pose && !egg.tried_headings.empty()) {
    // Every other side is taken: the ones that failed before are better than none.
    pose = choose_approach(*snapshot.robot_in_map, egg.egg_in_map, approach_, queries.pose_cost);
  }
  if (refusals_ == 0) egg.attempts += 1;
  changed_ = true;
  if (!pose) {
    attempt_failed(egg, fmt::format("no free pose around the {}", rules().target));
    return;
  }
  egg.phase = EggPhase::kApproaching;
  arrived_.reset();
  unseen_before_ = std::numeric_limits<int>::max();
  drive_to(*pose, snapshot, now);
}

/// A drive that is refused before it began says something about this side of the egg, not about the
/// egg: another side, without using up an attempt.
bool Mission::try_another_side(const MissionSnapshot& snapshot, EggTask& egg) {
  if (refusals_ >= config_.max_refusals ||
      distance(*snapshot.robot_in_map, drive_->from_in_map) > kMoved) {
    return false;
  }
  ++refusals_;
  egg.tried_headings.push_back(drive_->goal.pose_in_map.yaw);
  drive_.reset();
  changed_ = true;
  return true;
}

/// Equation 4 again while the robot comes nearer and sees the egg better.
void Mission::refresh_goal(const MissionSnapshot& snapshot, const EggTask& egg,
                           const MapQueries& queries) {
  const Pose2& old = drive_->goal.pose_in_map;
  if (distance(*snapshot.robot_in_map, old) < config_.refresh_until) return;
  const Pose2 moved{egg.egg_in_map.x() - approach_.distance * std::cos(old.yaw),
                    egg.egg_in_map.y() - approach_.distance * std::sin(old.yaw), old.yaw};
  if (distance(moved, old) < config_.refresh_distance || !queries.pose_cost(moved)) return;
  drive_->goal.pose_in_map = moved;
  actions_.goal = drive_->goal;
}

void Mission::step_approach(const MissionSnapshot& snapshot, const MapQueries& queries, Time now) {
  EggTask* egg = state_.find_egg(state_.current_egg);
  if (egg == nullptr) {
    enter(MissionPhase::kOrdering, "order lost");
    return;
  }
  if (!drive_) {
    begin_approach(snapshot, queries, now);
    return;
  }
  if (arrived_) {
    (this->*rules().at_target)(snapshot, now);
    return;
  }
  const NavigationReport result = drive_result(snapshot, now);
  if ((this->*rules().on_the_way)(snapshot, *egg)) return;
  switch (result.state) {
    case NavigationReport::State::kUnderWay:
      refresh_goal(snapshot, *egg, queries);
      if (!actions_.goal) repeat_goal(now);
      break;
    case NavigationReport::State::kArrived:
      arrived_ = now;
      refusals_ = 0;
      break;
    case NavigationReport::State::kFailed:
      if (!try_another_side(snapshot, *egg)) attempt_failed(*egg, result.reason);
      break;
  }
}

void Mission::attempt_failed(EggTask& egg, const std::string& reason) {
  if (drive_) egg.tried_headings.push_back(drive_->goal.pose_in_map.yaw);
  drive_.reset();
  arrived_.reset();
  refusals_ = 0;
  egg.reason = reason;
  egg.phase = egg.attempts >= config_.max_attempts ? EggPhase::kFailed : EggPhase::kQueued;
  changed_ = true;
  enter(MissionPhase::kOrdering, egg.id + ": " + reason);
}

}  // namespace coop::sequencer
