#include "global_planner/path_planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/error.hpp"
#include "core/costmap/footprint.hpp"
#include "global_planner/path_smoother.hpp"

namespace coop::global_planner {
namespace {

constexpr double kApproachSpacing = 0.1;  ///< m between the poses checked along the approach
constexpr double kFloodSlack = 6.0;       ///< m of free ground past the start: room for manoeuvres

Failure<PlanFailure> failure(PlanFailureReason reason, std::string detail) {
  return fail(PlanFailure{reason, std::move(detail), std::nullopt});
}

double length_of(const std::vector<Pose2>& poses) {
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) length += distance(poses[i - 1], poses[i]);
  return length;
}

/// The middles of the path's cells; an any-angle path has only its turns, and gets points between
/// them as near to each other as those of other paths.
std::vector<Eigen::Vector2d> points_along(const GridGeometry& geometry,
                                          const std::vector<Cell>& cells) {
  std::vector<Eigen::Vector2d> points{geometry.center_of(cells.front())};
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const Eigen::Vector2d from = geometry.center_of(cells[i - 1]);
    const Eigen::Vector2d step = geometry.center_of(cells[i]) - from;
    const int parts = std::max(1, static_cast<int>(step.norm() / geometry.resolution));
    for (int part = 1; part <= parts; ++part) points.push_back(from + step * part / parts);
  }
  if (points.size() == 1) points.push_back(points.front());
  return points;
}

PlanFailureReason reason_of(SearchFailure failure) {
  switch (failure) {
    case SearchFailure::kStartBlocked:
      return PlanFailureReason::kStartBlocked;
    case SearchFailure::kGoalBlocked:
      return PlanFailureReason::kGoalBlocked;
    case SearchFailure::kStartOutside:
    case SearchFailure::kEmptyGrid:
      return PlanFailureReason::kStartOutside;
    case SearchFailure::kGoalOutside:
      return PlanFailureReason::kGoalOutside;
    case SearchFailure::kNoPath:
    case SearchFailure::kCostsDiffer:
      break;
  }
  return PlanFailureReason::kNoPath;
}

}  // namespace

void PathPlannerConfig::describe(config::Fields& fields) {
  fields.choice("planner", planner, kPlanners,
                {.help = "hybrid_astar: manoeuvres of the base; the others search the grid alone"});
  fields.number("spacing", spacing,
                {.unit = "m", .help = "between poses of the path", .min = 0.01, .max = 0.5});
  fields.number("open_radius", open_radius,
                {.unit = "m",
                 .help = "around start and goal, in which inscribed cells may be crossed",
                 .min = 0,
                 .max = 5});
  fields.number("alternative_reach", alternative_reach,
                {.unit = "m",
                 .help = "distance from a blocked goal within which a free pose is looked for",
                 .min = 0,
                 .max = 5});
  fields.section("traversal", traversal);
  fields.section("poses", poses);
  fields.section("drivable_search", drivable_search);
  fields.section("swarms", swarms);
}

void PathPlannerConfig::validate() const {
  if (planner != kJumpPoint) return;
  if (traversal.restricted_weight != 0.0 ||
      (traversal.allow_unknown && traversal.unknown_weight != 0.0)) {
    throw config::Error(
        "path.planner: jump_point searches grids without prices: expected "
        "path.traversal.restricted_weight: 0 (and unknown_weight: 0 where unknown is allowed)");
  }
}

PathPlanner::PathPlanner(const PathPlannerConfig& config,
                         const std::vector<Eigen::Vector2d>& footprint, double min_turning_radius,
                         const RandomStream& random)
    : config_(config),
      footprint_(footprint),
      grid_(config.traversal),
      search_(config.drivable_search, min_turning_radius),
      grid_planner_(make_grid_planner(config.planner, config.swarms, random)) {}

PoseChecker& PathPlanner::checker_for(double resolution) {
  if (!checker_ || checker_resolution_ != resolution) {
    checker_.emplace(config_.poses, footprint_, resolution);
    checker_resolution_ = resolution;
  }
  return *checker_;
}

double PathPlanner::reach(double resolution) {
  return checker_for(resolution).reach();
}

Result<Plan, PlanFailure> PathPlanner::plan(const Costmap& costmap, const Pose2& start,
                                            const Pose2& goal, int direction) {
  if (auto wrong = check_ends(costmap, start, goal)) return fail(std::move(*wrong));
  const GridGeometry& geometry = costmap.geometry();
  const Cell start_cell = geometry.cell_of(start.position());
  const Cell goal_cell = geometry.cell_of(goal.position());
  grid_.update(costmap.costs());
  grid_.open_around(start_cell, config_.open_radius);
  grid_.open_around(goal_cell, config_.open_radius);
  auto plan = grid_planner_ ? grid_plan(start, goal) : drivable_plan(start, goal, direction);
  if (plan) plan->length = length_of(plan->poses);
  return plan;
}

/// Floods the grid from where the longest straight approach begins that is free and can be reached,
/// and gives its length.
std::optional<double> PathPlanner::flood_from_approach(Cell start, const Pose2& goal) {
  for (const double length : search_.approaches()) {
    bool free = true;
    for (double back = length; back > 0.0 && free; back -= kApproachSpacing) {
      free = checker_->free(goal * Pose2{-back, 0.0, 0.0});
    }
    const Cell source = grid_.geometry().cell_of((goal * Pose2{-length, 0.0, 0.0}).position());
    if (!free || !grid_.passable(source)) continue;
    dijkstra_.flood_past(grid_, source, start, kFloodSlack);
    if (std::isfinite(cost_near(start))) return length;
  }
  return std::nullopt;
}

std::optional<PlanFailure> PathPlanner::check_ends(const Costmap& costmap, const Pose2& start,
                                                   const Pose2& goal) {
  using enum PlanFailureReason;
  const GridGeometry& geometry = costmap.geometry();
  const auto goal_cell = cell_within(geometry, goal.position());
  if (!cell_within(geometry, start.position())) {
    return PlanFailure{kStartOutside, "the robot is outside the map", std::nullopt};
  }
  if (!goal_cell || !std::isfinite(goal.yaw)) {
    return PlanFailure{kGoalOutside, "the goal lies outside the map", std::nullopt};
  }
  if (costmap.cost_at(*goal_cell) == kUnknownCost && !config_.traversal.allow_unknown) {
    return PlanFailure{kGoalUnknown, "the goal lies where the map is unknown", std::nullopt};
  }
  const auto prepared = checker_for(geometry.resolution).prepare(costmap.distances(), start, goal);
  if (prepared) return std::nullopt;
  if (prepared.error() == PoseFailure::kStartBlocked) {
    return PlanFailure{kStartBlocked, "the robot stands on an obstacle of the map", std::nullopt};
  }
  PlanFailure blocked{kGoalBlocked, "the robot does not fit at the goal",
                      find_alternative(costmap, start, goal)};
  return blocked;
}

std::optional<Pose2> PathPlanner::find_alternative(const Costmap& costmap, const Pose2& start,
                                                   const Pose2& goal) {
  constexpr double kStep = 0.1;
  constexpr int kHeadings = 24;
  constexpr double kMetresPerRadian = 1.0;  // how far a turned goal counts as moved
  const GridGeometry& geometry = costmap.geometry();
  grid_.update(costmap.costs());
  grid_.open_around(geometry.cell_of(start.position()), config_.open_radius);
  if (!grid_.passable(geometry.cell_of(start.position()))) return std::nullopt;
  dijkstra_.flood(grid_, geometry.cell_of(start.position()),
                  std::numeric_limits<double>::infinity());
  const PoseChecker& checker = checker_for(geometry.resolution);
  const int reach = static_cast<int>(config_.alternative_reach / kStep);
  std::optional<Pose2> best;
  double best_change = std::numeric_limits<double>::infinity();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double moved = kStep * std::hypot(dx, dy);
      if (moved > config_.alternative_reach || moved >= best_change) continue;
      const Eigen::Vector2d at(goal.x + kStep * dx, goal.y + kStep * dy);
      if (!std::isfinite(dijkstra_.cost_to_goal(geometry.cell_of(at)))) continue;
      for (int turn = 0; turn < kHeadings; ++turn) {
        const double yaw = normalize_angle(turn * 2.0 * std::numbers::pi / kHeadings);
        const double change = moved + kMetresPerRadian * std::abs(yaw);
        const Pose2 pose{at.x(), at.y(), normalize_angle(goal.yaw + yaw)};
        if (change >= best_change || !checker.fits(costmap.distances(), pose)) continue;
        best_change = change;
        best = pose;
      }
    }
  }
  return best;
}

double PathPlanner::cost_near(Cell cell) const {
  double cost = dijkstra_.cost_to_goal(cell);
  const int reach =
      static_cast<int>(config_.open_radius / std::max(1e-6, grid_.geometry().resolution));
  // A robot that stands on an obstacle cell of the map may find its way from a cell nearby.
  for (int ring = 1; ring <= reach && !std::isfinite(cost); ++ring) {
    for (int d = -ring; d <= ring; ++d) {
      for (const Cell near : {Cell{cell.x + d, cell.y - ring}, Cell{cell.x + d, cell.y + ring},
                              Cell{cell.x - ring, cell.y + d}, Cell{cell.x + ring, cell.y + d}}) {
        cost = std::min(cost, dijkstra_.cost_to_goal(near));
      }
    }
  }
  return cost;
}

Result<Plan, PlanFailure> PathPlanner::drivable_plan(const Pose2& start, const Pose2& goal,
                                                     int direction) {
  const Cell start_cell = grid_.geometry().cell_of(start.position());
  const auto approach = flood_from_approach(start_cell, goal);
  if (!approach) {
    return failure(PlanFailureReason::kNoPath, "obstacles lie all round the goal or the robot");
  }
  const auto path = search_.plan({grid_, dijkstra_, *checker_, *approach}, start, goal, direction);
  if (!path) {
    return failure(PlanFailureReason::kNoPath,
                   path.error() == DrivableFailure::kExhausted
                       ? "no manoeuvre of this base leads to the goal's heading"
                       : "no manoeuvre found within the limit of the search");
  }
  Plan plan;
  plan.poses = sample(path->arcs, start, config_.spacing);
  plan.poses.back() = goal;
  plan.cost = path->cost;
  plan.states = path->states;
  plan.grid_cost = cost_near(start_cell) + *approach;
  return plan;
}

Result<Plan, PlanFailure> PathPlanner::grid_plan(const Pose2& start, const Pose2& goal) {
  const GridGeometry& geometry = grid_.geometry();
  const auto path = grid_planner_->plan(grid_, geometry.cell_of(start.position()),
                                        geometry.cell_of(goal.position()));
  if (!path) return failure(reason_of(path.error()), std::string(to_string(path.error())));
  std::vector<Eigen::Vector2d> points = points_along(geometry, path->cells);
  points.front() = start.position();
  points.back() = goal.position();
  Plan plan;
  plan.poses = orient(smooth(grid_, std::move(points)), config_.spacing, goal.yaw);
  plan.cost = path->cost;
  plan.grid_cost = path->cost;
  return plan;
}

bool PathPlanner::still_free(const Costmap& costmap, const Pose2* first, const Pose2* last) {
  const PoseChecker& checker = checker_for(costmap.geometry().resolution);
  return std::all_of(first, last,
                     [&](const Pose2& pose) { return checker.fits(costmap.distances(), pose); });
}

}  // namespace coop::global_planner
