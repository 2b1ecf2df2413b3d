#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "global_planner/path_planner.hpp"
#include "global_planner/planning_map.hpp"

namespace coop::global_planner {

/// When to plan anew.
struct ReplanConfig {
  double check_period = 0.5;    ///< s between two looks at the plan in force
  double improve_period = 3.0;  ///< s between two searches for a better one
  double improvement =
      0.25;  ///< a plan must be cheaper by this part, and 0.5 m, to replace a good one
  double goal_tolerance = 0.05;            ///< m: a goal moved by less keeps the plan
  double goal_turn_tolerance = 0.05;       ///< rad
  double goal_tolerance_per_metre = 0.05;  ///< m (and rad) more for each metre still to drive
  double stray_distance = 0.35;            ///< m: a robot farther from its plan gets a new one
  double patience = 10.0;  ///< s without map, pose or path while driving before the goal fails

  void describe(config::Fields& fields);
};

struct GlobalPlannerConfig {
  PlanningMapConfig map;
  PathPlannerConfig path;
  ReplanConfig replan;

  void describe(config::Fields& fields);
};

struct Goal {
  std::string id;
  Pose2 pose_in_map;
};

enum class PlannerState : std::uint8_t { kIdle, kPlanning, kPlanned, kFailed, kCancelled };
enum class PlannerReason : std::uint8_t {
  kNone,
  kNoMap,
  kNoPose,
  kStartBlocked,
  kGoalBlocked,
  kGoalOutside,
  kGoalUnknown,
  kNoPath,
};

struct PlannerStatus {
  PlannerState state = PlannerState::kIdle;
  PlannerReason reason = PlannerReason::kNone;
  std::string detail;
  std::string goal_id;
  Pose2 goal_in_map;
  double path_cost = 0.0;            ///< m of free ground
  double path_length = 0.0;          ///< m
  std::optional<Pose2> alternative;  ///< to a blocked goal
  bool operator==(const PlannerStatus&) const = default;
};

/// The part of the local planner's report that concerns the global one.
struct DriverReport {
  std::string goal_id;
  bool arrived = false;
  bool failed = false;          ///< gave up for good
  bool wants_new_plan = false;  ///< blocked, or at the end of the plan without having met the goal
};

/// Keeps a plan to the goal while one is active. A plan stays as long as it is good: it is replaced
/// when the goal moved, the robot strayed, an obstacle lies on it, the driver asks, or a clearly
/// cheaper one exists; so it does not flip to and fro between ways of nearly equal cost.
class GlobalPlanner {
 public:
  /// `random`: for planners that use chance.
  GlobalPlanner(const GlobalPlannerConfig& config, const std::vector<Eigen::Vector2d>& footprint,
                double min_turning_radius, const RandomStream& random);

  /// Called every some milliseconds during a long update().
  void on_progress(std::function<void()> callback) { planner_.on_progress(std::move(callback)); }

  [[nodiscard]] PlanningMap& map() { return map_; }
  [[nodiscard]] const PlanningMap& map() const { return map_; }

  /// The same goal told again changes nothing, also after its end.
  void set_goal(const Goal& goal, Time now);
  /// Takes back the goal of that name, or, where the name is empty, whichever is in force; its plan
  /// is replaced by none, and the same goal told again stays taken back. False: another goal is in
  /// force, which stays.
  bool cancel(const std::string& goal_id);
  void report(const DriverReport& report);

  struct Changes {
    bool plan = false;
    bool status = false;
    bool costmap = false;
    const char* why = "";  ///< the plan changed
  };
  /// To be called at 5 to 20 Hz. `robot_in_map`: nothing where the pose is unknown or stale.
  Changes update(const std::optional<Pose2>& robot_in_map, Time now);

  [[nodiscard]] const std::vector<Pose2>& plan() const { return plan_.poses; }  ///< empty: none
  [[nodiscard]] const PlannerStatus& status() const { return status_; }

 private:
  void pursue(const std::optional<Pose2>& robot, Time now);
  void wait(PlannerReason reason, const char* detail, Time now);
  void plan_anew(const Pose2& robot, Time now);
  void accept(Plan plan, const Pose2& robot, Time now);
  void fail_goal(PlannerReason reason, const std::string& detail, std::optional<Pose2> alternative);
  [[nodiscard]] const char* why_plan(const Pose2& robot);
  void follow_progress(const Pose2& robot);
  [[nodiscard]] bool goal_moved() const;
  void look_for_better(const Pose2& robot, Time now);
  void estimate_direction(const Pose2& robot, Time now);
  void drop_plan();

  GlobalPlannerConfig config_;
  PathPlanner planner_;
  PlanningMap map_;
  PlannerStatus status_;
  PlannerStatus announced_;  ///< as of the last update()
  std::optional<Goal> goal_;
  std::string finished_goal_;  ///< id of the last one that came to its end or was taken back
  Plan plan_;
  Pose2 planned_goal_;
  std::vector<double> distances_;  ///< along plan_, m
  std::size_t progress_ = 0;       ///< pose of plan_ nearest to the robot
  bool plan_changed_ = false;
  const char* why_changed_ = "";
  bool wanted_by_driver_ = false;
  bool check_now_ = false;
  Time next_check_{};
  Time next_improvement_{};
  std::optional<Time> failing_since_;
  std::optional<StampedPose2> last_robot_;
  int direction_ = 0;
};

}  // namespace coop::global_planner
