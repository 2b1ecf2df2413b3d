#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sequencer/mission.hpp"

// What only the cleaning of a pen does: heaps are driven over, and whether they are gone the camera
// above tells once the robot is out of its sight.
namespace coop::sequencer {
namespace {

/// m between two steps: more is no drive but a correction of the pose.
constexpr double kJump = 0.3;

}  // namespace

/// A camera above sees the whole pen at once: some pictures of it, then the order.
void Mission::order_heaps(const MissionSnapshot& snapshot) {
  if (!pictures_before_) pictures_before_ = snapshot.pictures;
  if (snapshot.pictures - *pictures_before_ < config_.look_pictures) {
    state_.next_waypoint = state_.waypoints.size();
    enter(MissionPhase::kSearching, "looking at the pen");
    return;
  }
  pictures_before_.reset();
  enter(MissionPhase::kOrdering, fmt::format("{} heaps known", known_eggs()));
}

/// A heap is cleaned when the blade has passed over it going forwards, whichever heap the robot was
/// on its way to. One that the blade has missed after all is seen again and becomes a new target.
void Mission::note_swept(const MissionSnapshot& snapshot) {
  const Pose2 robot = *snapshot.robot_in_map;
  const Pose2 before = std::exchange(observed_from_, robot).value_or(robot);
  if (!scraper_) return;
  if (distance(before, robot) > kJump) ahead_of_blade_.clear();
  const bool forwards = (before.inverse() * robot).x > 0.0;
  const double half_width = 0.5 * scraper_->sizes().y() - config_.sweep_margin;
  for (EggTask& heap : state_.eggs) {
    if (heap.phase == EggPhase::kPicked) continue;
    const Eigen::Vector2d in_base = robot.inverse() * heap.egg_in_map;
    if (in_base.x() > scraper_->center().x()) {
      ahead_of_blade_.insert(heap.id);
      continue;
    }
    // Remembered from the step before, as the place of a heap half hidden by the robot shifts.
    if (!forwards || ahead_of_blade_.erase(heap.id) == 0) continue;
    if (std::abs(in_base.y()) > half_width) continue;
    heap.phase = EggPhase::kPicked;
    heap.reason.clear();
    actions_.picked_eggs.push_back(heap.id);
    changed_ = true;
    if (state_.phase != MissionPhase::kDriving || heap.id != state_.current_egg) continue;
    drive_.reset();
    arrived_.reset();
    refusals_ = 0;
    enter(MissionPhase::kOrdering, heap.id + " cleaned");
  }
}

/// What failed is tried again after a pause: first from where the robot stands, then from home, as
/// it may be the robot itself that keeps a pig in its corner.
bool Mission::waits_for_pigs(const std::vector<const EggTask*>& put_off, Time now) {
  constexpr int kTriesFromNearby = 2;
  if (put_off.empty()) return false;
  const bool tried_nearby = std::ranges::all_of(
      put_off, [](const EggTask* heap) { return heap->attempts >= kTriesFromNearby; });
  if (tried_nearby && config_.return_home && !is_home_) {
    waiting_since_.reset();
    enter(MissionPhase::kReturning, "out of the pigs' way");
    return true;
  }
  if (!waiting_since_) waiting_since_ = now;
  if (now - *waiting_since_ < seconds(config_.retry_pause)) return true;
  waiting_since_.reset();
  return false;
}

void Mission::step_beside_heap(const MissionSnapshot& snapshot, Time now) {
  EggTask& heap = *state_.find_egg(state_.current_egg);
  if (now - *arrived_ < seconds(config_.settle_time)) return;
  const Eigen::Vector2d in_base = snapshot.robot_in_map->inverse() * heap.egg_in_map;
  attempt_failed(heap, fmt::format("heap at ({:.2f}, {:.2f}) m on arrival, the blade missed it",
                                   in_base.x(), in_base.y()));
}

/// Where the robot stands the camera sees no floor: it drives home first.
void Mission::go_home_and_look(Time now) {
  if (config_.return_home && !is_home_) {
    enter(MissionPhase::kReturning, "home");
    return;
  }
  take_goal_back(now);
  if (!last_look_) last_look_ = now;
  if (now - *last_look_ < seconds(config_.last_look)) return;
  last_look_.reset();
  is_home_ = false;
  finish();
}

void Mission::look_back() {
  is_home_ = true;
  drive_.reset();
  enter(MissionPhase::kOrdering, "looking back");
}

}  // namespace coop::sequencer
