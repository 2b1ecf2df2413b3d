#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "dwa/dwa.hpp"
#include "experiments/navigation/duck_house.hpp"
#include "global_planner/global_planner.hpp"

namespace coop::test {

struct ClosedLoopConfig {
  double time_limit = 240.0;         ///< s for one egg
  int max_goals = 6;                 ///< approach poses tried for one egg
  double position_noise = 0.0;       ///< m, of the localisation at each scan
  double heading_noise = 0.0;        ///< rad
  double range_noise = 0.0;          ///< m, of the laser
  double goal_refresh_period = 0.0;  ///< s; 0: the goal is sent once
  double goal_refresh_noise = 0.0;   ///< m, of the egg in a refreshed goal
  bool keep_clear_of_egg = true;
  std::vector<Eigen::Vector3d> new_obstacles;  ///< discs (x, y, radius) that are not in the map
  dwa::DwaConfig dwa;
  global_planner::GlobalPlannerConfig planner;

  void describe(config::Fields& fields);
};

/// One moment of a run, for pictures.
struct Moment {
  double time = 0.0;
  Pose2 robot;
  Twist2 velocity;
  Pose2 believed;
};

struct RunResult {
  bool arrived = false;  ///< dwa said so
  bool success = false;  ///< and the egg lies within reach: 0.92 +- 0.10 m ahead, +- 0.12 m beside
  int collisions = 0;    ///< moments at which the true robot overlapped an obstacle
  bool ran_over_egg = false;
  double time = 0.0;    ///< s
  double driven = 0.0;  ///< m
  int goals = 0;        ///< approach poses tried
  int plans = 0;
  int direction_changes = 0;
  Eigen::Vector2d egg_in_base{0, 0};  ///< at the end
  double worst_offset = 0.0;          ///< m beside the plan
  double dwa_cpu = 0.0;               ///< s
  double planner_cpu = 0.0;           ///< s
  std::string failure;
  std::vector<std::string> log;  ///< what planner and dwa said
  std::vector<Moment> moments;   ///< every 0.1 s
  std::vector<std::vector<Pose2>> plans_made;
  std::vector<Pose2> goals_sent;
};

/// Global planner and dwa driving a simulated Ackermann base in the duck house, without middleware:
/// kinematics with acceleration and steering rate limits at 50 Hz, laser scans by ray casting at 10
/// Hz, control at 20 Hz.
[[nodiscard]] RunResult run_closed_loop(const ClosedLoopConfig& config, const OccupancyGrid& house,
                                        const EggTask& task, std::uint64_t seed);

}  // namespace coop::test
