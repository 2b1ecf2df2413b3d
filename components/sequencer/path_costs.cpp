#include "sequencer/path_costs.hpp"

#include <cmath>
#include <limits>

namespace coop::sequencer {
namespace {

/// From a place in a blocked cell a passable one is looked for up to here, m.
constexpr double kSearchRadius = 1.5;

Cost to_cost(std::int8_t percent) {
  if (percent < 0) return kUnknownCost;
  if (percent >= 100) return kLethalCost;
  if (percent == 99) return kInscribedCost;
  return static_cast<Cost>(percent * kMaxRestrictedCost / 98);
}

}  // namespace

PathCosts::PathCosts(const Footprint& footprint, const TraversalConfig& traversal)
    : footprint_(footprint), grid_(traversal) {}

void PathCosts::set_costmap(const OccupancyGrid& costmap) {
  Grid<Cost> costs(costmap.geometry, kFreeCost);
  std::vector<std::uint8_t> lethal(costmap.cells.size());
  for (std::size_t i = 0; i < costmap.cells.size(); ++i) {
    costs.cells[i] = to_cost(costmap.cells[i]);
    lethal[i] = costs.cells[i] == kLethalCost ? 1 : 0;
  }
  grid_.update(costs);
  checker_.emplace(footprint_, costmap.geometry.resolution);
  obstacles_.update(costmap.geometry, lethal, checker_->reach());
  flooded_from_.reset();
}

std::optional<Cell> PathCosts::passable_near(const Eigen::Vector2d& place) const {
  if (!place.allFinite()) return std::nullopt;
  const Cell middle = grid_.geometry().cell_of(place);
  if (grid_.passable(middle)) return middle;
  const int reach = static_cast<int>(kSearchRadius / grid_.geometry().resolution);
  std::optional<Cell> best;
  int best_squared = reach * reach + 1;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int squared = dx * dx + dy * dy;
      const Cell cell{middle.x + dx, middle.y + dy};
      if (squared < best_squared && grid_.passable(cell)) {
        best_squared = squared;
        best = cell;
      }
    }
  }
  return best;
}

void PathCosts::flood(Cell cell) {
  if (flooded_from_ == cell) return;
  search_.flood(grid_, cell, std::numeric_limits<double>::infinity());
  flooded_from_ = cell;
}

std::optional<double> PathCosts::pose_cost(const Pose2& robot_in_map, const Pose2& pose_in_map) {
  if (!checker_ || checker_->collides(obstacles_, pose_in_map)) return std::nullopt;
  const auto start = passable_near(robot_in_map.position());
  if (!start) return std::nullopt;
  flood(*start);
  const double cost = search_.cost_to_goal(grid_.geometry().cell_of(pose_in_map.position()));
  if (!std::isfinite(cost)) return std::nullopt;
  return cost;
}

std::vector<double> PathCosts::costs_from(const Pose2& robot_in_map,
                                          const std::vector<Eigen::Vector2d>& places_in_map) {
  std::vector<double> costs(places_in_map.size(), std::numeric_limits<double>::infinity());
  const auto start = passable_near(robot_in_map.position());
  if (!start) return costs;
  flood(*start);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (const auto cell = passable_near(places_in_map[i])) costs[i] = search_.cost_to_goal(*cell);
  }
  return costs;
}

CostMatrix PathCosts::matrix(const Pose2& robot_in_map,
                             const std::vector<Eigen::Vector2d>& places_in_map) {
  const std::size_t nodes = places_in_map.size() + 1;
  CostMatrix costs(nodes, std::numeric_limits<double>::infinity());
  std::vector<std::optional<Cell>> cells{passable_near(robot_in_map.position())};
  for (const Eigen::Vector2d& place : places_in_map) cells.push_back(passable_near(place));
  for (std::size_t to = 0; to < nodes; ++to) {
    costs.at(to, to) = 0.0;
    if (!cells[to]) continue;
    flood(*cells[to]);
    for (std::size_t from = 0; from < nodes; ++from) {
      if (from != to && cells[from]) costs.at(from, to) = search_.cost_to_goal(*cells[from]);
    }
  }
  return costs;
}

}  // namespace coop::sequencer
