#include "sequencer/mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace coop::sequencer {

void Mission::enter(MissionPhase phase, const std::string& detail) {
  if (state_.phase == phase && state_.detail == detail) return;
  state_.phase = phase;
  state_.detail = detail;
  changed_ = true;
}

void Mission::start(MissionKind kind, const std::string& mission_id,
                    std::vector<Waypoint> waypoints) {
  state_ = MissionState{};
  state_.mission_id = mission_id;
  state_.kind = kind;
  state_.waypoints = std::move(waypoints);
  drive_.reset();
  enter(MissionPhase::kSearching, "starting");
}

void Mission::pause() {
  if (!state_.is_active() || state_.phase == MissionPhase::kPaused) return;
  state_.resume_phase = state_.phase;
  drive_.reset();
  enter(MissionPhase::kPaused, "paused");
}

void Mission::resume() {
  if (state_.phase != MissionPhase::kPaused) return;
  drive_.reset();
  arrived_.reset();
  // A drive begins anew from where the robot stands now.
  const bool was_driving = state_.resume_phase == MissionPhase::kDriving;
  enter(was_driving ? MissionPhase::kOrdering : state_.resume_phase, "resumed");
}

void Mission::abort(const std::string& reason) {
  if (!state_.is_active()) return;
  drive_.reset();
  enter(MissionPhase::kFailed, reason);
}

MissionActions Mission::step(const MissionSnapshot& snapshot, const MapQueries& queries, Time now) {
  actions_ = {};
  if (state_.is_active() && snapshot.robot_in_map) {
    if (!state_.has_home) {
      state_.has_home = true;
      state_.home_in_map = *snapshot.robot_in_map;
      changed_ = true;
    }
    adopt_eggs(snapshot);
    switch (state_.phase) {
      case MissionPhase::kSearching:
        step_waypoints(snapshot, now);
        break;
      case MissionPhase::kOrdering:
        step_ordering(snapshot, queries);
        break;
      case MissionPhase::kDriving:
        step_approach(snapshot, queries, now);
        break;
      case MissionPhase::kPicking:
        step_picking(snapshot, now);
        break;
      case MissionPhase::kReturning:
        step_returning(snapshot, now);
        break;
      case MissionPhase::kPaused:
        stand_still(snapshot, now);
        break;
      default:
        break;
    }
  }
  actions_.state_changed = std::exchange(changed_, false);
  return std::exchange(actions_, {});
}

/// Confirmed tracks become eggs of the mission; positions follow the tracks until the pick.
void Mission::adopt_eggs(const MissionSnapshot& snapshot) {
  if (state_.kind != MissionKind::kCollect || snapshot.tracks == nullptr) return;
  for (const EggTrack& track : *snapshot.tracks) {
    if (!track.confirmed || track.picked) continue;
    EggTask* egg = state_.find_egg(track.id);
    if (egg == nullptr) {
      state_.eggs.push_back({.id = track.id,
                             .egg_in_map = track.egg_in_map,
                             .phase = EggPhase::kSeen,
                             .attempts = 0,
                             .tried_headings = {},
                             .reason = {}});
      changed_ = true;
      // Seen on the way to another: the order is made anew when that one is done.
    } else if (egg->phase != EggPhase::kPicking && egg->phase != EggPhase::kPicked) {
      egg->egg_in_map = track.egg_in_map;
    }
  }
}

void Mission::drive_to(const Pose2& pose, Time now) {
  // The shell stamps the goal with this time; its digits are the goal's name on all topics.
  drive_ = Drive{{std::to_string(to_nanoseconds(now)), pose}, now, now};
  actions_.goal = drive_->goal;
}

void Mission::repeat_goal(Time now) {
  if (now - drive_->told < seconds(config_.goal_repeat)) return;
  drive_->told = now;
  actions_.goal = drive_->goal;
}

NavigationReport Mission::drive_result(const MissionSnapshot& snapshot, Time now) const {
  using State = NavigationReport::State;
  if (snapshot.navigation && snapshot.navigation->goal_id == drive_->goal.goal_id &&
      snapshot.navigation->state != State::kUnderWay) {
    return *snapshot.navigation;
  }
  if (now - drive_->begun > seconds(config_.goal_timeout)) {
    return {drive_->goal.goal_id, State::kFailed,
            fmt::format("not there after {:.0f} s", config_.goal_timeout)};
  }
  return {drive_->goal.goal_id, State::kUnderWay, ""};
}

void Mission::step_waypoints(const MissionSnapshot& snapshot, Time now) {
  const bool enough = state_.kind == MissionKind::kCollect && config_.expected_eggs > 0 &&
                      static_cast<int>(state_.eggs.size()) >= config_.expected_eggs;
  if (enough || state_.next_waypoint >= state_.waypoints.size()) {
    end_search_or_mission();
    return;
  }
  const Waypoint& waypoint = state_.waypoints[state_.next_waypoint];
  if (!drive_) {
    drive_to(waypoint.pose_in_map, now);
    enter(MissionPhase::kSearching, fmt::format("to {} ({} of {})", waypoint.name,
                                                state_.next_waypoint + 1, state_.waypoints.size()));
    return;
  }
  const NavigationReport result = drive_result(snapshot, now);
  // A waypoint is there to be seen from, not to be stood on; only the last one is driven to its
  // end.
  const bool passes =
      state_.next_waypoint + 1 < state_.waypoints.size() &&
      distance(*snapshot.robot_in_map, waypoint.pose_in_map) < config_.waypoint_radius;
  if (result.state == NavigationReport::State::kUnderWay && !passes) {
    repeat_goal(now);
    return;
  }
  if (result.state == NavigationReport::State::kFailed) {
    state_.missed_waypoints.push_back(waypoint.name + ": " + result.reason);
  }
  drive_.reset();
  state_.next_waypoint += 1;
  changed_ = true;
}

void Mission::end_search_or_mission() {
  drive_.reset();
  state_.searches += 1;
  if (state_.kind == MissionKind::kCollect) {
    enter(MissionPhase::kOrdering, fmt::format("{} eggs known", state_.eggs.size()));
    return;
  }
  finish();
}

bool Mission::wants_another_search() const {
  return static_cast<int>(state_.eggs.size()) < config_.expected_eggs &&
         state_.searches < config_.max_searches && !state_.waypoints.empty();
}

/// The other way round, so that the camera sees what it had its back to.
void Mission::search_again() {
  std::ranges::reverse(state_.waypoints);
  for (Waypoint& waypoint : state_.waypoints) {
    waypoint.pose_in_map.yaw = normalize_angle(waypoint.pose_in_map.yaw + std::numbers::pi);
  }
  state_.next_waypoint = 0;
  changed_ = true;
  enter(MissionPhase::kSearching, fmt::format("{} of {} eggs known, search {}", state_.eggs.size(),
                                              config_.expected_eggs, state_.searches + 1));
}

void Mission::finish() {
  drive_.reset();
  std::string detail;
  if (state_.kind == MissionKind::kCollect) {
    detail =
        fmt::format("{} of {} eggs picked", state_.count(EggPhase::kPicked), state_.eggs.size());
  } else {
    detail = fmt::format("{} of {} waypoints reached",
                         state_.waypoints.size() - state_.missed_waypoints.size(),
                         state_.waypoints.size());
  }
  enter(MissionPhase::kDone, detail);
}

void Mission::step_ordering(const MissionSnapshot& snapshot, const MapQueries& queries) {
  std::vector<const EggTask*> open;
  for (const EggTask& egg : state_.eggs) {
    if (egg.phase != EggPhase::kPicked && egg.phase != EggPhase::kFailed) open.push_back(&egg);
  }
  state_.current_egg.clear();
  if (open.empty()) {
    if (wants_another_search()) {
      search_again();
    } else if (config_.return_home) {
      enter(MissionPhase::kReturning, "home");
    } else {
      finish();
    }
    return;
  }
  const OrderedEggs ordered = queries.order(*snapshot.robot_in_map, open);
  if (ordered.order.empty()) return;  // no map yet
  for (const std::string& id : ordered.order) state_.find_egg(id)->phase = EggPhase::kQueued;
  // What was picked stays in front: the order tells the whole tour.
  std::erase_if(state_.order, [this](const std::string& id) {
    const EggTask* egg = state_.find_egg(id);
    return egg == nullptr || egg->phase != EggPhase::kPicked;
  });
  if (state_.order.empty()) {
    state_.tour_cost = ordered.cost;
    state_.tour_cost_alternative = ordered.alternative_cost;
  }
  state_.order.insert(state_.order.end(), ordered.order.begin(), ordered.order.end());
  state_.current_egg = ordered.order.front();
  arrived_.reset();
  changed_ = true;
  enter(MissionPhase::kDriving, "to " + state_.current_egg);
}

void Mission::begin_approach(const MissionSnapshot& snapshot, const MapQueries& queries, Time now) {
  EggTask& egg = *state_.find_egg(state_.current_egg);
  auto pose = choose_approach(*snapshot.robot_in_map, egg.egg_in_map, approach_, queries.pose_cost,
                              egg.tried_headings);
  if (!pose && !egg.tried_headings.empty()) {
    // Every other side is taken: the ones that failed before are better than none.
    pose = choose_approach(*snapshot.robot_in_map, egg.egg_in_map, approach_, queries.pose_cost);
  }
  egg.attempts += 1;
  changed_ = true;
  if (!pose) {
    attempt_failed(egg, "no free pose around the egg");
    return;
  }
  egg.phase = EggPhase::kApproaching;
  arrived_.reset();
  drive_to(*pose, now);
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
  switch (result.state) {
    case NavigationReport::State::kUnderWay:
      refresh_goal(snapshot, *egg, queries);
      if (!actions_.goal) repeat_goal(now);
      break;
    case NavigationReport::State::kArrived:
      arrived_ = now;
      break;
    case NavigationReport::State::kFailed:
      attempt_failed(*egg, result.reason);
      break;
  }
}

void Mission::step_arrival(const MissionSnapshot& snapshot, Time now) {
  if (now - *arrived_ < seconds(config_.settle_time)) return;
  EggTask& egg = *state_.find_egg(state_.current_egg);
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
    egg->phase = EggPhase::kPicked;
    egg->reason.clear();
    actions_.picked_egg = egg->id;
    state_.pick_id.clear();
    pick_begun_.reset();
    changed_ = true;
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

void Mission::attempt_failed(EggTask& egg, const std::string& reason) {
  if (drive_) egg.tried_headings.push_back(drive_->goal.pose_in_map.yaw);
  drive_.reset();
  arrived_.reset();
  egg.reason = reason;
  egg.phase = egg.attempts >= config_.max_attempts ? EggPhase::kFailed : EggPhase::kQueued;
  changed_ = true;
  enter(MissionPhase::kOrdering, egg.id + ": " + reason);
}

void Mission::step_returning(const MissionSnapshot& snapshot, Time now) {
  if (!drive_) {
    drive_to(state_.home_in_map, now);
    return;
  }
  const NavigationReport result = drive_result(snapshot, now);
  if (result.state == NavigationReport::State::kUnderWay) {
    repeat_goal(now);
    return;
  }
  if (result.state == NavigationReport::State::kFailed) {
    state_.missed_waypoints.push_back("home: " + result.reason);
  }
  finish();
}

/// The goal of a pause is where the robot is: the navigators stop there.
void Mission::stand_still(const MissionSnapshot& snapshot, Time now) {
  if (!drive_) drive_to(*snapshot.robot_in_map, now);
}

}  // namespace coop::sequencer
