#include "global_planner/global_planner.hpp"

#include <algorithm>
#include <cmath>

#include "core/costmap/footprint.hpp"

namespace coop::global_planner {
namespace {

constexpr double kUsualResolution = 0.05;  ///< m: of the maps, for the reach of distance fields
constexpr double kSearchBack = 0.3;        ///< m along the plan
constexpr double kSearchAhead = 1.5;       ///< m along the plan
constexpr double kHeadingArm = 0.3;        ///< m
constexpr double kDirectionPeriod = 0.25;  ///< s
constexpr double kDrivingDistance = 0.02;  ///< m within that period
constexpr double kWorthwhile = 0.5;        ///< m of free ground

PlannerReason reason_of(PlanFailureReason reason) {
  switch (reason) {
    case PlanFailureReason::kStartOutside:
    case PlanFailureReason::kStartBlocked:
      return PlannerReason::kStartBlocked;
    case PlanFailureReason::kGoalOutside:
      return PlannerReason::kGoalOutside;
    case PlanFailureReason::kGoalUnknown:
      return PlannerReason::kGoalUnknown;
    case PlanFailureReason::kGoalBlocked:
      return PlannerReason::kGoalBlocked;
    case PlanFailureReason::kNoPath:
      break;
  }
  return PlannerReason::kNoPath;
}

}  // namespace

void ReplanConfig::describe(config::Fields& fields) {
  fields.number(
      "check_period", check_period,
      {.unit = "s", .help = "between two looks at the plan in force", .min = 0.05, .max = 10});
  fields.number(
      "improve_period", improve_period,
      {.unit = "s", .help = "between two searches for a better plan", .min = 0.1, .max = 600});
  fields.number(
      "improvement", improvement,
      {.help = "a plan must be cheaper by this part to replace a good one", .min = 0, .max = 1});
  fields.number("goal_tolerance", goal_tolerance,
                {.unit = "m", .help = "a goal moved by less keeps the plan", .min = 0, .max = 1});
  fields.number(
      "goal_turn_tolerance", goal_turn_tolerance,
      {.unit = "rad", .help = "a goal turned by less keeps the plan", .min = 0, .max = 1});
  fields.number(
      "goal_tolerance_per_metre", goal_tolerance_per_metre,
      {.unit = "m/m", .help = "more of both for each metre to drive", .min = 0, .max = 1});
  fields.number(
      "stray_distance", stray_distance,
      {.unit = "m", .help = "a robot farther from its plan gets a new one", .min = 0.05, .max = 5});
  fields.number("patience", patience,
                {.unit = "s",
                 .help = "without map, pose or path while driving before the goal fails",
                 .min = 0,
                 .max = 600});
}

void GlobalPlannerConfig::describe(config::Fields& fields) {
  fields.section("map", map);
  fields.section("path", path);
  fields.section("replan", replan);
}

GlobalPlanner::GlobalPlanner(const GlobalPlannerConfig& config,
                             const std::vector<Eigen::Vector2d>& footprint,
                             double min_turning_radius, const RandomStream& random)
    : config_(config),
      planner_(config.path, footprint, min_turning_radius, random),
      map_(config.map, Footprint(footprint), config.path.poses.padding,
           planner_.reach(kUsualResolution)) {}

void GlobalPlanner::set_goal(const Goal& goal, Time now) {
  if (goal.id == finished_goal_) return;  // told again while the news of its end was under way
  const bool first = !goal_;
  const bool renamed = goal_ && goal_->id != goal.id;
  goal_ = goal;
  status_.goal_id = goal.id;
  status_.goal_in_map = goal.pose_in_map;
  next_check_ = now;
  if (first) {
    drop_plan();
    failing_since_.reset();
  } else if (renamed && !plan_.poses.empty() && !goal_moved()) {
    plan_changed_ = true;  // the same poses under the new goal's name
  }
}

bool GlobalPlanner::cancel(const std::string& goal_id) {
  if (goal_ && !goal_id.empty() && goal_id != goal_->id) return false;
  finished_goal_ = goal_ ? goal_->id : goal_id;
  goal_.reset();
  drop_plan();
  failing_since_.reset();
  // Also where no goal is known here: the driver may hold a plan of before this planner's start.
  plan_changed_ = true;
  why_changed_ = "the goal was taken back";
  status_ = {};
  status_.state = PlannerState::kCancelled;
  status_.goal_id = finished_goal_;
  return true;
}

void GlobalPlanner::drop_plan() {
  plan_changed_ = plan_changed_ || !plan_.poses.empty();
  plan_ = {};
  distances_.clear();
  progress_ = 0;
  wanted_by_driver_ = false;
}

void GlobalPlanner::report(const DriverReport& report) {
  if (!goal_ || report.goal_id != goal_->id) return;
  if (report.arrived || report.failed) {
    finished_goal_ = goal_->id;
    goal_.reset();
    status_.state = PlannerState::kIdle;
    status_.reason = PlannerReason::kNone;
    status_.detail.clear();
    return;
  }
  if (report.wants_new_plan && !wanted_by_driver_) {
    wanted_by_driver_ = true;
    check_now_ = true;
  }
  if (!report.wants_new_plan) wanted_by_driver_ = false;
}

GlobalPlanner::Changes GlobalPlanner::update(const std::optional<Pose2>& robot_in_map, Time now) {
  Changes changes;
  if (robot_in_map) estimate_direction(*robot_in_map, now);
  if (goal_ && (now >= next_check_ || check_now_)) {
    next_check_ = now + seconds(config_.replan.check_period);
    changes.costmap = map_.update(now, robot_in_map);
    pursue(robot_in_map, now);
    check_now_ = false;
  } else if (!goal_ && now >= next_check_) {
    next_check_ = now + seconds(2.0 * config_.replan.check_period);
    changes.costmap = map_.update(now, robot_in_map);
  }
  changes.plan = plan_changed_;
  changes.why = why_changed_;
  plan_changed_ = false;
  // Goals and reports change the status between two calls as well.
  changes.status = !(status_ == announced_);
  announced_ = status_;
  return changes;
}

void GlobalPlanner::estimate_direction(const Pose2& robot, Time now) {
  if (last_robot_ && to_seconds(now - last_robot_->stamp) < kDirectionPeriod &&
      now >= last_robot_->stamp) {
    return;
  }
  if (last_robot_) {
    const double along = (last_robot_->pose.inverse() * robot).x;
    direction_ = along > kDrivingDistance ? 1 : (along < -kDrivingDistance ? -1 : 0);
  }
  last_robot_ = {now, robot};
}

void GlobalPlanner::pursue(const std::optional<Pose2>& robot, Time now) {
  if (!map_.has_map()) return wait(PlannerReason::kNoMap, "no map yet", now);
  if (!robot) return wait(PlannerReason::kNoPose, "the robot's pose is unknown", now);
  if (!plan_.poses.empty()) follow_progress(*robot);
  if (const char* why = why_plan(*robot); why != nullptr) {
    why_changed_ = why;
    plan_anew(*robot, now);
  } else {
    failing_since_.reset();
    if (now >= next_improvement_) look_for_better(*robot, now);
  }
}

void GlobalPlanner::wait(PlannerReason reason, const char* detail, Time now) {
  if (!failing_since_) failing_since_ = now;
  status_.state = PlannerState::kPlanning;
  status_.reason = reason;
  status_.detail = detail;
  if (to_seconds(now - *failing_since_) >= config_.replan.patience) {
    fail_goal(reason, detail, std::nullopt);
  }
}

const char* GlobalPlanner::why_plan(const Pose2& robot) {
  if (plan_.poses.empty()) return "no plan yet";
  if (goal_moved()) return "the goal moved";
  if (check_now_ && wanted_by_driver_) return "the driver asks";
  if (distance(plan_.poses[progress_], robot) > config_.replan.stray_distance) {
    return "the robot strayed";
  }
  const Pose2* first = plan_.poses.data() + progress_;
  const Pose2* last = plan_.poses.data() + plan_.poses.size();
  if (!planner_.still_free(map_.costmap(), first, last)) return "an obstacle is on the plan";
  return nullptr;
}

bool GlobalPlanner::goal_moved() const {
  const double to_drive = distances_.empty() ? 0.0 : distances_.back() - distances_[progress_];
  const double more = config_.replan.goal_tolerance_per_metre * to_drive;
  const double turn = angle_difference(goal_->pose_in_map.yaw, planned_goal_.yaw);
  return distance(goal_->pose_in_map, planned_goal_) > config_.replan.goal_tolerance + more ||
         std::abs(turn) > config_.replan.goal_turn_tolerance + more;
}

void GlobalPlanner::follow_progress(const Pose2& robot) {
  double best = std::numeric_limits<double>::infinity();
  std::size_t nearest = progress_;
  for (std::size_t i = 0; i < plan_.poses.size(); ++i) {
    const double ahead = distances_[i] - distances_[progress_];
    if (ahead < -kSearchBack || ahead > kSearchAhead) continue;
    const double turn = kHeadingArm * angle_difference(plan_.poses[i].yaw, robot.yaw);
    const double error = std::hypot(distance(plan_.poses[i], robot), turn);
    if (error >= best) continue;
    best = error;
    nearest = i;
  }
  progress_ = nearest;
}

void GlobalPlanner::plan_anew(const Pose2& robot, Time now) {
  auto plan = planner_.plan(map_.costmap(), robot, goal_->pose_in_map, direction_);
  if (plan) return accept(std::move(*plan), robot, now);
  PlanFailure& failure = plan.error();
  const PlannerReason reason = reason_of(failure.reason);
  if (!failing_since_) failing_since_ = now;
  const bool lasting = to_seconds(now - *failing_since_) >= config_.replan.patience;
  // A robot on its way keeps what it has for a while: what blocks the way may walk on, and the
  // driver stops before it.
  if (plan_.poses.empty() || goal_moved() || lasting) {
    fail_goal(reason, failure.detail, failure.alternative);
    return;
  }
  status_.reason = reason;
  status_.detail = failure.detail;
}

void GlobalPlanner::accept(Plan plan, const Pose2& robot, Time now) {
  plan_ = std::move(plan);
  planned_goal_ = goal_->pose_in_map;
  distances_.assign(plan_.poses.size(), 0.0);
  for (std::size_t i = 1; i < plan_.poses.size(); ++i) {
    distances_[i] = distances_[i - 1] + distance(plan_.poses[i - 1], plan_.poses[i]);
  }
  progress_ = 0;
  follow_progress(robot);
  plan_changed_ = true;
  failing_since_.reset();
  next_improvement_ = now + seconds(config_.replan.improve_period);
  status_.state = PlannerState::kPlanned;
  status_.reason = PlannerReason::kNone;
  status_.detail.clear();
  status_.path_cost = plan_.cost;
  status_.path_length = plan_.length;
  status_.alternative.reset();
}

void GlobalPlanner::look_for_better(const Pose2& robot, Time now) {
  next_improvement_ = now + seconds(config_.replan.improve_period);
  status_.state = PlannerState::kPlanned;
  status_.reason = PlannerReason::kNone;
  status_.detail.clear();
  const double left = distances_.back() - distances_[progress_];
  if (left < 2.0 * kWorthwhile || distances_.back() <= 0.0) return;
  const double cost_left = plan_.cost * left / distances_.back();
  auto plan = planner_.plan(map_.costmap(), robot, goal_->pose_in_map, direction_);
  if (!plan) return;
  if (plan->cost < (1.0 - config_.replan.improvement) * cost_left &&
      plan->cost < cost_left - kWorthwhile) {
    why_changed_ = "a better way was found";
    accept(std::move(*plan), robot, now);
  }
}

void GlobalPlanner::fail_goal(PlannerReason reason, const std::string& detail,
                              std::optional<Pose2> alternative) {
  goal_.reset();
  drop_plan();
  failing_since_.reset();
  status_.state = PlannerState::kFailed;
  status_.reason = reason;
  status_.detail = detail;
  status_.alternative = alternative;
  status_.path_cost = 0.0;
  status_.path_length = 0.0;
}

}  // namespace coop::global_planner
