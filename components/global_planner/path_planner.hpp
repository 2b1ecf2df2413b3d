#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/costmap.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"
#include "core/result.hpp"
#include "core/search/dijkstra.hpp"
#include "core/search/grid_planner.hpp"
#include "global_planner/drivable_search.hpp"
#include "global_planner/planner_choice.hpp"
#include "global_planner/pose_checker.hpp"

namespace coop::global_planner {

struct PathPlannerConfig {
  /// One of kPlanners. hybrid_astar: a path the base can drive, ending with the goal's heading. The
  /// others search the grid alone; their path is smoothed, every pose turned to the next (dijkstra:
  /// as in the egg paper).
  std::string planner{kHybridAStar};
  double spacing = 0.05;     ///< m between poses
  double open_radius = 0.8;  ///< m around start and goal in which inscribed cells may be crossed
  double alternative_reach = 1.0;  ///< m from a blocked goal within which a free pose is looked for
  TraversalConfig traversal;
  PoseCheckerConfig poses;
  DrivableConfig drivable_search;
  swarm::SwarmConfig swarms;

  void describe(config::Fields& fields);
  /// Jump point search needs a grid without prices.
  void validate() const;
};

/// Poses of base_link from start to goal. Where the next pose lies behind, against the heading, the
/// robot is to drive backwards.
struct Plan {
  std::vector<Pose2> poses;
  double length = 0.0;     ///< m
  double cost = 0.0;       ///< m of free ground
  double grid_cost = 0.0;  ///< of the search over the grid, start to goal, m of free ground
  std::size_t states = 0;  ///< expanded by the drivable search
};

enum class PlanFailureReason : std::uint8_t {
  kStartOutside,
  kStartBlocked,
  kGoalOutside,
  kGoalUnknown,
  kGoalBlocked,
  kNoPath,
};

struct PlanFailure {
  PlanFailureReason reason;
  std::string detail;
  std::optional<Pose2> alternative;  ///< free, reachable pose nearest to a blocked goal
};

/// One query from start to goal over a costmap.
class PathPlanner {
 public:
  /// `random`: for planners that use chance.
  PathPlanner(const PathPlannerConfig& config, const std::vector<Eigen::Vector2d>& footprint,
              double min_turning_radius, const RandomStream& random);

  /// `direction`: which way the robot drives now (1, -1), 0 at rest. Poses in the costmap's frame.
  [[nodiscard]] Result<Plan, PlanFailure> plan(const Costmap& costmap, const Pose2& start,
                                               const Pose2& goal, int direction);

  /// Called every some milliseconds during a long plan().
  void on_progress(std::function<void()> callback) { search_.on_progress(std::move(callback)); }

  /// Whether the robot still fits along the poses, with the tight padding: a path planned with the
  /// full one does not fall at every flicker of a cell.
  [[nodiscard]] bool still_free(const Costmap& costmap, const Pose2* first, const Pose2* last);

  /// Distance that collision checks need at that resolution, m.
  [[nodiscard]] double reach(double resolution);

 private:
  PoseChecker& checker_for(double resolution);
  [[nodiscard]] std::optional<PlanFailure> check_ends(const Costmap& costmap, const Pose2& start,
                                                      const Pose2& goal);
  [[nodiscard]] std::optional<Pose2> find_alternative(const Costmap& costmap, const Pose2& start,
                                                      const Pose2& goal);
  [[nodiscard]] double cost_near(Cell cell) const;
  [[nodiscard]] Result<Plan, PlanFailure> drivable_plan(const Pose2& start, const Pose2& goal,
                                                        int direction);
  [[nodiscard]] std::optional<double> flood_from_approach(Cell start, const Pose2& goal);
  [[nodiscard]] Result<Plan, PlanFailure> grid_plan(const Pose2& start, const Pose2& goal);

  PathPlannerConfig config_;
  std::vector<Eigen::Vector2d> footprint_;
  std::optional<PoseChecker> checker_;
  double checker_resolution_ = 0.0;
  TraversalGrid grid_;
  Dijkstra dijkstra_;
  DrivableSearch search_;
  std::unique_ptr<GridPlanner> grid_planner_;  ///< null: hybrid A*
};

}  // namespace coop::global_planner
