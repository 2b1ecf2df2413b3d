#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_set>

#include "sequencer/mission.hpp"

// The part of the mission that is about one egg: order, approach, look, pick.
namespace coop::sequencer {
namespace {

/// m: a robot this far from where it was told to go has begun to drive there; one that still rolls
/// from the drive before has not.
constexpr double kMoved = 0.3;

}  // namespace

/// Confirmed tracks become eggs of the mission; positions follow the tracks until the pick.
void Mission::adopt_eggs(const MissionSnapshot& snapshot) {
  if (state_.kind != MissionKind::kCollect || snapshot.tracks == nullptr) return;
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

/// Nothing is left to do, unless the camera finds in a moment what the arm lost.
void Mission::end_or_search_again(Time now) {
  take_goal_back(now);
  if (!last_look_) last_look_ = now;
  const bool any_picked = state_.count(EggPhase::kPicked) > 0;
  if (any_picked && now - *last_look_ < seconds(config_.last_look)) return;
  last_look_.reset();
  if (wants_another_search()) {
    search_again();
  } else if (config_.return_home) {
    enter(MissionPhase::kReturning, "home");
  } else {
    finish();
  }
}

void Mission::step_ordering(const MissionSnapshot& snapshot, const MapQueries& queries, Time now) {
  std::vector<const EggTask*> open;
  std::vector<const EggTask*> unseen;  // later: whoever sat on the egg may have gone by then
  for (const EggTask& egg : state_.eggs) {
    if (egg.phase == EggPhase::kPicked || egg.phase == EggPhase::kFailed ||
        egg.phase == EggPhase::kMissing) {
      continue;
    }
    (egg.unseen > 0 ? unseen : open).push_back(&egg);
  }
  if (open.empty()) open.swap(unseen);
  state_.current_egg.clear();
  if (open.empty()) return end_or_search_again(now);
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
  for (const EggTask* egg : unseen) state_.order.push_back(egg->id);
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
    attempt_failed(egg, "no free pose around the egg");
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
    step_arrival(snapshot, now);
    return;
  }
  const NavigationReport result = drive_result(snapshot, now);
  if (pictures_without(snapshot, *egg) >= config_.unseen_after) return egg_not_seen(*egg);
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

void Mission::step_arrival(const MissionSnapshot& snapshot, Time now) {
  EggTask& egg = *state_.find_egg(state_.current_egg);
  const int without = pictures_without(snapshot, egg);
  if (without >= config_.unseen_after) return egg_not_seen(egg);
  const Duration standing = now - *arrived_;
  if (standing < seconds(config_.settle_time)) return;
  if (without > 0 && standing < seconds(config_.look_time)) return;  // the pictures disagree
  if (!is_within_reach(*snapshot.robot_in_map, egg.egg_in_map, approach_)) {
    const Eigen::Vector2d egg_in_base = snapshot.robot_in_map->inverse() * egg.egg_in_map;
    attempt_failed(egg, fmt::format("egg at ({:.2f}, {:.2f}) m on arrival, out of reach",
                                    egg_in_base.x(), egg_in_base.y()));
    return;
  }
  drive_.reset();
  arrived_.reset();
  egg.phase = EggPhase::kPicking;
  state_.pick_id = fmt::format("{}/{}/{}", state_.mission_id, egg.id, egg.attempts);
  changed_ = true;
  enter(MissionPhase::kPicking, egg.id);
}

void Mission::step_picking(const MissionSnapshot& snapshot, Time now) {
  EggTask* egg = state_.find_egg(state_.current_egg);
  if (egg == nullptr || state_.pick_id.empty()) {
    enter(MissionPhase::kOrdering, "pick lost");
    return;
  }
  if (!pick_begun_) {
    pick_begun_ = now;
    pick_told_ = Time{};
  }
  const bool answered =
      snapshot.pick && snapshot.pick->pick_id == state_.pick_id && snapshot.pick->is_final;
  if (answered && snapshot.pick->picked) {
    egg_picked(*egg);
    state_.pick_id.clear();
    pick_begun_.reset();
    enter(MissionPhase::kOrdering, egg->id + " picked");
    return;
  }
  if (answered || now - *pick_begun_ > seconds(config_.pick_timeout)) {
    state_.pick_id.clear();
    pick_begun_.reset();
    attempt_failed(*egg, answered ? snapshot.pick->reason : "the arm does not answer");
    return;
  }
  if (now - pick_told_ >= seconds(config_.pick_repeat)) {
    pick_told_ = now;
    actions_.pick = PickOrder{state_.pick_id, egg->id, egg->egg_in_map};
  }
}

void Mission::egg_picked(EggTask& egg) {
  egg.phase = EggPhase::kPicked;
  egg.reason.clear();
  actions_.picked_egg = egg.id;
  changed_ = true;
}

/// The arm's answer to a pick that was given up: the egg is in the basket all the same.
void Mission::note_late_pick(const MissionSnapshot& snapshot) {
  if (!snapshot.pick || !snapshot.pick->picked || !snapshot.pick->is_final) return;
  const std::string& pick_id = snapshot.pick->pick_id;
  const std::string ours = state_.mission_id + "/";
  if (pick_id == state_.pick_id || !pick_id.starts_with(ours)) return;
  const std::string_view rest = std::string_view(pick_id).substr(ours.size());
  EggTask* egg = state_.find_egg(rest.substr(0, rest.rfind('/')));
  if (egg == nullptr || egg->phase == EggPhase::kPicked) return;
  egg_picked(*egg);
  if (state_.current_egg != egg->id) return;
  drive_.reset();
  arrived_.reset();
  refusals_ = 0;
  state_.pick_id.clear();
  pick_begun_.reset();
  if (state_.phase == MissionPhase::kPaused) {
    state_.resume_phase = MissionPhase::kOrdering;
  } else {
    enter(MissionPhase::kOrdering, egg->id + " picked after all");
  }
}

int Mission::pictures_without(const MissionSnapshot& snapshot, const EggTask& egg) {
  if (snapshot.tracks == nullptr) return 0;
  const auto track = std::ranges::find(*snapshot.tracks, egg.id, &EggTrack::id);
  if (track == snapshot.tracks->end()) return 0;
  const bool is_near =
      arrived_ || distance(*snapshot.robot_in_map, drive_->goal.pose_in_map) < config_.look_from;
  unseen_before_ = is_near ? std::min(unseen_before_, track->unseen_in_row) : track->unseen_in_row;
  return track->unseen_in_row - unseen_before_;
}

/// Never picked blindly and never dropped: looked for once more from another side, then reported.
void Mission::egg_not_seen(EggTask& egg) {
  egg.unseen += 1;
  attempt_failed(
      egg, fmt::format("not there: {} pictures of its place without it", config_.unseen_after));
  if (egg.unseen >= config_.max_looks || egg.phase == EggPhase::kFailed) {
    egg.phase = EggPhase::kMissing;
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
