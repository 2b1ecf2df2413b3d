#include "dwa/dwa.hpp"

#include <algorithm>
#include <cmath>

#include "dwa/speed_limit.hpp"

namespace coop::dwa {
namespace {

constexpr double kStandstill = 0.02;     ///< m/s: slower than this counts as standing
constexpr double kSteeringKnown = 0.10;  ///< m/s: from here on omega / v tells the steering angle
constexpr double kProgress = 0.10;       ///< m
constexpr double kAwaitPlanTime = 2.0;   ///< s
constexpr int kMaxMisses = 4;
constexpr double kLookAheadForBends = 0.3;  ///< m
constexpr double kTurnNowWithin = 0.08;     ///< m: the wheels are to point right this soon

std::string seconds_text(double value) {
  return std::to_string(value).substr(0, 4) + " s";
}

}  // namespace

Dwa::Dwa(const DwaConfig& config, const std::vector<Eigen::Vector2d>& footprint,
         const vehicle::AckermannGeometry& base, double steering_rate)
    : config_(config),
      base_(base),
      steering_rate_(steering_rate),
      chooser_(config, footprint, base, steering_rate),
      local_map_(config.local_map, Footprint(footprint),
                 std::max(chooser_.reach(), config.critic.max_obstacle_distance)),
      animals_(config.animals, Footprint(footprint, config.prediction.padding),
               config.prediction.prediction_step) {}

void Dwa::set_plan(const std::string& goal_id, std::vector<Pose2> poses_in_map) {
  const bool same_goal = goal_id == goal_id_;
  // Given up: only another goal starts the robot again.
  if (same_goal && mode_ == Mode::kFailed) return;
  goal_id_ = goal_id;
  // The same way under the name of a goal that hardly moved: nothing begins anew.
  if (poses_in_map == plan_ && !plan_.empty() && mode_ != Mode::kFailed) return;
  if (!same_goal) {
    back_ups_ = 0;
    misses_ = 0;
    progress_at_ = Time{};
    blocked_since_ = Time{};
  }
  plan_ = std::move(poses_in_map);
  has_new_plan_ = true;
}

DwaOutput Dwa::update(const DwaInputs& inputs, Time now) {
  chosen_.clear();
  std::string detail;
  const DriveReason reason = check_inputs(inputs, now, detail);
  if (reason != DriveReason::kNone) {
    last_update_ = Time{};
    return stand(reason, std::move(detail));
  }
  const Here here = locate(inputs, now);
  local_map_.update(here.base_in_odom, here.odom_in_map, now);
  animals_.place(here.base_in_odom, here.odom_in_map, now);
  track_.record(here.base_in_odom);
  if (has_new_plan_) {
    has_new_plan_ = false;
    path_.set(plan_, here.base_in_map());
    if (mode_ != Mode::kBackUp || path_.empty()) {
      mode_ = path_.empty() ? Mode::kIdle : Mode::kFollow;
      mode_since_ = now;
    }
    if (!path_.empty()) best_to_goal_ = path_.to_goal();
    if (progress_at_ == Time{}) progress_at_ = now;
  }
  return drive(here);
}

DriveReason Dwa::check_inputs(const DwaInputs& inputs, Time now, std::string& detail) const {
  const RecoveryConfig& limits = config_.recovery;
  const auto stale = [&](std::optional<Time> stamp, const char* what, double timeout) {
    const double age = stamp ? to_seconds(now - *stamp) : 0.0;
    if (stamp && std::abs(age) <= timeout) return false;
    detail = std::string("no ") + what + (stamp ? " for " + seconds_text(age) : " yet");
    return true;
  };
  if (inputs.emergency_stop) {
    detail = "emergency stop";
    return DriveReason::kEmergencyStop;
  }
  const auto odometry = inputs.odometry ? std::optional(inputs.odometry->stamp) : std::nullopt;
  if (stale(odometry, "odometry", limits.input_timeout)) return DriveReason::kNoPose;
  const auto transform =
      inputs.odom_in_map ? std::optional(inputs.odom_in_map->stamp) : std::nullopt;
  if (stale(transform, "transform map to odom", limits.transform_timeout)) {
    return DriveReason::kNoPose;
  }
  if (stale(inputs.scan_stamp, "scan", limits.input_timeout)) return DriveReason::kSensorStale;
  return DriveReason::kNone;
}

Dwa::Here Dwa::locate(const DwaInputs& inputs, Time now) {
  const Odometry& odometry = *inputs.odometry;
  const double age = std::clamp(to_seconds(now - odometry.stamp), 0.0, 0.2);
  const double dt = last_update_ == Time{} ? config_.control_period
                                           : std::min(0.5, to_seconds(now - last_update_));
  // After a pause (stale input, emergency stop) nothing may count as time without progress.
  if (last_update_ == Time{}) {
    if (progress_at_ != Time{}) progress_at_ = now;
    if (blocked_since_ != Time{}) blocked_since_ = now;
    mode_since_ = now;
  }
  last_update_ = now;
  const double turn = steering_rate_ * dt;
  steering_ += std::clamp(wanted_steering_ - steering_, -turn, turn);
  estimate_steering(odometry.velocity.v, odometry.velocity.omega);
  return {now,
          vehicle::advance_along_arc(odometry.base_in_odom, odometry.velocity.v * age,
                                     odometry.velocity.omega * age),
          inputs.odom_in_map->pose, odometry.velocity.v};
}

/// At rest nobody measures the steering angle; then it is where the last commands have brought it.
void Dwa::estimate_steering(double speed, double omega) {
  if (std::abs(speed) < kSteeringKnown) return;
  const double measured = vehicle::steering_of_curvature(base_, omega / speed);
  steering_ +=
      0.3 * (std::clamp(measured, -base_.max_steering_angle, base_.max_steering_angle) - steering_);
}

DwaOutput Dwa::stand(DriveReason reason, std::string detail) {
  DwaOutput output;
  wanted_steering_ = steering_;
  switch (mode_) {
    case Mode::kIdle:
      output.state = DriveState::kIdle;
      break;
    case Mode::kArrived:
      output.state = DriveState::kArrived;
      break;
    case Mode::kFailed:
      output.state = DriveState::kFailed;
      break;
    default:
      output.state = DriveState::kDriving;
  }
  output.reason = reason;
  output.detail = std::move(detail);
  output.distance_remaining = path_.empty() ? 0.0 : path_.to_goal();
  return output;
}

DwaOutput Dwa::drive(const Here& here) {
  switch (mode_) {
    case Mode::kIdle:
    case Mode::kArrived:
      return stand(DriveReason::kNone, "");
    case Mode::kFailed:
      return stand(DriveReason::kStuck, "given up");
    case Mode::kAwaitPlan:
      return await_plan(here);
    case Mode::kBackUp:
      return back_up(here);
    case Mode::kFollow:
      break;
  }
  return follow_plan(here);
}

DwaOutput Dwa::follow_plan(const Here& here) {
  const Pose2 base_in_map = here.base_in_map();
  path_.follow(base_in_map);
  if (!progressing(here)) {
    mode_ = Mode::kFailed;
    return stand(DriveReason::kStuck,
                 "no progress for " + seconds_text(config_.recovery.give_up_time));
  }
  double remaining = path_.to_segment_end(base_in_map);
  const bool standing = std::abs(here.speed) < kStandstill;
  if (remaining <= config_.arrival.stop_distance) {
    if (!standing) return stand(DriveReason::kNone, "stopping");
    if (path_.on_last_segment()) return finish(here);
    path_.next_segment();
    path_.follow(base_in_map);
    remaining = path_.to_segment_end(base_in_map);
  }
  if (!standing && here.speed * path_.direction() < 0.0) {
    return stand(DriveReason::kNone, "stopping to change direction");
  }
  const double limit = speed_limit(here, path_, remaining);
  const auto command = steer(here, path_, here.odom_in_map.inverse(), limit);
  if (!command) return blocked(here);
  blocked_since_ = Time{};
  return driving(*command);
}

bool Dwa::progressing(const Here& here) {
  if (path_.to_goal() < best_to_goal_ - kProgress) {
    best_to_goal_ = path_.to_goal();
    progress_at_ = here.now;
  }
  return to_seconds(here.now - progress_at_) < config_.recovery.give_up_time;
}

DwaOutput Dwa::finish(const Here& here) {
  const ArrivalConfig& arrival = config_.arrival;
  const Pose2 error = path_.goal().inverse() * here.base_in_map();
  const double lateral = error.y + arrival.reach * std::sin(error.yaw);
  const bool met = std::abs(error.x) <= arrival.along_tolerance &&
                   std::abs(lateral) <= arrival.lateral_tolerance;
  if (met) {
    mode_ = Mode::kArrived;
    return stand(DriveReason::kNone, "");
  }
  if (++misses_ > kMaxMisses) {
    mode_ = Mode::kFailed;
    return stand(DriveReason::kStuck, "cannot stop close enough to the goal");
  }
  mode_ = Mode::kAwaitPlan;
  mode_since_ = here.now;
  return stand(DriveReason::kMissedGoal, "the goal was missed");
}

DwaOutput Dwa::blocked(const Here& here) {
  if (blocked_since_ == Time{}) blocked_since_ = here.now;
  const double time = to_seconds(here.now - blocked_since_);
  if (time >= config_.recovery.patience) {
    start_back_up(here);
    return stand(DriveReason::kStuck, "blocked: backing up");
  }
  // While an animal walks by it is enough to wait.
  if (time < config_.recovery.blocked_time) return stand(DriveReason::kNone, "blocked: waiting");
  return stand(DriveReason::kStuck, "blocked: a new plan is wanted");
}

DwaOutput Dwa::await_plan(const Here& here) {
  if (to_seconds(here.now - mode_since_) > kAwaitPlanTime) {
    if (back_ups_ == 0 && misses_ > 0) {
      mode_ = Mode::kFailed;
      return stand(DriveReason::kStuck, "the goal was missed and no new plan came");
    }
    mode_ = Mode::kFollow;
  }
  return stand(misses_ > 0 ? DriveReason::kMissedGoal : DriveReason::kStuck,
               "a new plan is wanted");
}

void Dwa::start_back_up(const Here& here) {
  if (++back_ups_ > config_.recovery.max_back_ups) {
    mode_ = Mode::kFailed;
    return;
  }
  back_.set(track_.take_back(here.base_in_odom, config_.recovery.back_up_distance),
            here.base_in_odom);
  mode_ = back_.empty() ? Mode::kAwaitPlan : Mode::kBackUp;
  mode_since_ = here.now;
  blocked_since_ = Time{};
}

DwaOutput Dwa::back_up(const Here& here) {
  back_.follow(here.base_in_odom);
  const bool standing = std::abs(here.speed) < kStandstill;
  const double remaining = back_.to_segment_end(here.base_in_odom);
  std::optional<Command> command;
  if (remaining > config_.arrival.stop_distance) {
    if (!standing && here.speed * back_.direction() < 0.0) {
      return stand(DriveReason::kStuck, "stopping to back up");
    }
    const double limit = std::min(speed_limit(here, back_, remaining), config_.speed.narrow_speed);
    command = steer(here, back_, Pose2{}, limit);
    if (command) return driving(*command);
  }
  if (!standing) return stand(DriveReason::kStuck, "backed up");
  mode_ = Mode::kAwaitPlan;
  mode_since_ = here.now;
  return stand(DriveReason::kStuck, "backed up: a new plan is wanted");
}

double Dwa::speed_limit(const Here& here, const TrackedPath& path, double remaining) {
  const SpeedConfig& config = config_.speed;
  double limit = path.direction() < 0 ? config.max_reverse : config.max_vel_x;
  limit = std::min(limit, braking_speed(config, remaining - config_.arrival.stop_distance));
  if (config_.paper()) return limit;
  const Pose2 near = path.pose_ahead(0.0);
  const Pose2 middle = path.pose_ahead(kLookAheadForBends);
  const Pose2 far = path.pose_ahead(2.0 * kLookAheadForBends);
  const double driven = path.direction() * kLookAheadForBends;
  const double first = angle_difference(middle.yaw, near.yaw) / driven;
  const double second = angle_difference(far.yaw, middle.yaw) / driven;
  limit = std::min({limit, bend_speed(config, first), bend_speed(config, second)});
  const double turn_now = vehicle::steering_of_curvature(base_, first) - steering_;
  const double turn_soon = vehicle::steering_of_curvature(base_, second) - steering_;
  limit = std::min({limit, steering_speed(config, turn_now, kTurnNowWithin, steering_rate_),
                    steering_speed(config, turn_soon, 1.5 * kLookAheadForBends, steering_rate_)});
  const double clearance = chooser_.clearance(local_map_.costmap().distances(), here.base_in_odom);
  return std::min(limit, narrow_speed(config, clearance));
}

std::optional<Command> Dwa::steer(const Here& here, const TrackedPath& path,
                                  const Pose2& path_in_odom, double max_speed) {
  window_.clear();
  for (double ahead = kPathSpacing; ahead <= config_.critic.match_distance + 1e-9;
       ahead += kPathSpacing) {
    window_.push_back(path_in_odom * path.pose_ahead(ahead));
  }
  Situation situation;
  situation.base = here.base_in_odom;
  situation.motion = {here.speed, steering_};
  situation.direction = path.direction();
  situation.max_speed = max_speed;
  situation.min_speed = config_.paper() ? 0.0 : std::min(max_speed, config_.speed.creep_speed);
  const Pose2 base_in_path = path_in_odom.inverse() * here.base_in_odom;
  situation.max_distance = std::max(0.0, path.to_segment_end(base_in_path)) + kPathSpacing;
  const double target_distance =
      config_.critic.target_distance + max_speed * config_.prediction.prediction_time;
  situation.target = (path_in_odom * path.pose_ahead(target_distance)).position();
  situation.path = window_;
  situation.obstacles = &local_map_.costmap().distances();
  situation.animals = &animals_;
  const Candidate* best = chooser_.choose(situation);
  if (best == nullptr) return std::nullopt;
  chosen_ = best->trajectory;
  return best->command;
}

DwaOutput Dwa::driving(const Command& command) {
  DwaOutput output;
  output.state = DriveState::kDriving;
  output.reason = mode_ == Mode::kBackUp ? DriveReason::kStuck : DriveReason::kNone;
  output.command = vehicle::twist_of(base_, command.speed, command.steering);
  output.distance_remaining = path_.empty() ? 0.0 : path_.to_goal();
  wanted_steering_ = command.steering;
  return output;
}

}  // namespace coop::dwa
