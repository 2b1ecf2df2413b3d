#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "sequencer/mission_rules.hpp"

namespace coop::sequencer {

void Mission::enter(MissionPhase phase, const std::string& detail) {
  if (state_.phase == phase && state_.detail == detail) return;
  state_.phase = phase;
  state_.detail = detail;
  changed_ = true;
}

void Mission::start(MissionKind kind, const std::string& mission_id,
                    std::vector<Waypoint> waypoints) {
  const std::string goal_in_force = std::exchange(state_.goal_id, {});
  state_ = MissionState{};
  state_.goal_id = goal_in_force;
  state_.mission_id = mission_id;
  state_.kind = kind;
  state_.waypoints = std::move(waypoints);
  drive_.reset();
  pictures_before_.reset();
  is_home_ = false;
  enter(MissionPhase::kSearching, "starting");
}

void Mission::pause() {
  if (!state_.is_active() || state_.phase == MissionPhase::kPaused) return;
  state_.resume_phase = state_.phase;
  drive_.reset();
  pick_begun_.reset();  // the arm's time begins anew with the mission's
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
  note_end_of_goal(snapshot);
  if (state_.is_active() && snapshot.robot_in_map) {
    if (!state_.has_home) {
      state_.has_home = true;
      state_.home_in_map = *snapshot.robot_in_map;
      changed_ = true;
    }
    adopt_eggs(snapshot);
    (this->*rules().observe)(snapshot);
    switch (state_.phase) {
      case MissionPhase::kSearching:
        step_waypoints(snapshot, now);
        break;
      case MissionPhase::kOrdering:
        step_ordering(snapshot, queries, now);
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
      default:
        break;
    }
  }
  if (!state_.is_active() || state_.phase == MissionPhase::kPaused) take_goal_back(now);
  actions_.state_changed = std::exchange(changed_, false);
  return std::exchange(actions_, {});
}

void Mission::drive_to(const Pose2& pose, const MissionSnapshot& snapshot, Time now) {
  // The shell stamps the goal with this time; its digits are the goal's name on all topics.
  is_home_ = false;
  drive_ = Drive{{std::to_string(to_nanoseconds(now)), pose}, *snapshot.robot_in_map, now, now};
  actions_.goal = drive_->goal;
  state_.goal_id = drive_->goal.goal_id;
  taken_back_ = Time{};
  changed_ = true;
}

void Mission::note_end_of_goal(const MissionSnapshot& snapshot) {
  if (state_.goal_id.empty() || !snapshot.navigation ||
      snapshot.navigation->goal_id != state_.goal_id ||
      snapshot.navigation->state == NavigationReport::State::kUnderWay) {
    return;
  }
  state_.goal_id.clear();
  changed_ = true;
}

/// The robot is to stand. Told again until a navigator answers: the planner may have been dead.
void Mission::take_goal_back(Time now) {
  drive_.reset();
  if (state_.goal_id.empty() || now - taken_back_ < seconds(config_.goal_repeat)) return;
  taken_back_ = now;
  actions_.take_back = state_.goal_id;
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
  if ((this->*rules().knows_enough)() || state_.next_waypoint >= state_.waypoints.size()) {
    drive_.reset();
    (this->*rules().after_search)(snapshot);
    if (state_.phase != MissionPhase::kSearching) state_.searches += 1;
    return;
  }
  const Waypoint& waypoint = state_.waypoints[state_.next_waypoint];
  if (!drive_) {
    drive_to(waypoint.pose_in_map, snapshot, now);
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

int Mission::known_eggs() const {
  return static_cast<int>(state_.eggs.size()) - state_.count(EggPhase::kMissing);
}

bool Mission::wants_another_search() const {
  return known_eggs() < config_.expected_eggs && state_.searches < config_.max_searches &&
         !state_.waypoints.empty();
}

/// The other way round, so that the camera sees what it had its back to.
void Mission::search_again() {
  std::ranges::reverse(state_.waypoints);
  for (Waypoint& waypoint : state_.waypoints) {
    waypoint.pose_in_map.yaw = normalize_angle(waypoint.pose_in_map.yaw + std::numbers::pi);
  }
  state_.next_waypoint = 0;
  changed_ = true;
  enter(MissionPhase::kSearching, fmt::format("{} of {} eggs known, search {}", known_eggs(),
                                              config_.expected_eggs, state_.searches + 1));
}

void Mission::finish() {
  drive_.reset();
  std::string detail;
  if (!rules().target.empty()) {
    detail = fmt::format("{} of {} {}s {}", state_.count(EggPhase::kPicked), state_.eggs.size(),
                         rules().target, rules().done);
    const int missing = state_.count(EggPhase::kMissing);
    if (missing > 0) detail += fmt::format(", {} missing", missing);
  } else {
    detail = fmt::format("{} of {} waypoints reached",
                         state_.waypoints.size() - state_.missed_waypoints.size(),
                         state_.waypoints.size());
  }
  enter(MissionPhase::kDone, detail);
}

void Mission::step_returning(const MissionSnapshot& snapshot, Time now) {
  if (!drive_) {
    drive_to(state_.home_in_map, snapshot, now);
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
  (this->*rules().at_home)();
}

}  // namespace coop::sequencer
