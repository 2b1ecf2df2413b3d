#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sequencer/mission.hpp"

// What only the collection of eggs does: look for them, pick them, search again.
namespace coop::sequencer {

bool Mission::knows_expected_eggs() const {
  return config_.expected_eggs > 0 && known_eggs() >= config_.expected_eggs;
}

void Mission::order_eggs(const MissionSnapshot& /*snapshot*/) {
  enter(MissionPhase::kOrdering, fmt::format("{} eggs known", known_eggs()));
}

bool Mission::looks_in_vain(const MissionSnapshot& snapshot, EggTask& egg) {
  if (pictures_without(snapshot, egg) < config_.unseen_after) return false;
  egg_not_seen(egg);
  return true;
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
  actions_.picked_eggs.push_back(egg.id);
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

}  // namespace coop::sequencer
