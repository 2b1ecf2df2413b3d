#include "sequencer/path_costs.hpp"

#include <cmath>
#include <limits>

namespace coop::sequencer {
namespace {

/// Around a blocked place the inscribed zone is opened this far, m.
constexpr double kOpenRadius = 1.0;

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

void PathCosts::flood(const Eigen::Vector2d& place) {
  const Cell cell = grid_.geometry().cell_of(place);
  if (flooded_from_ == cell) return;
  grid_.close();
  flooded_from_.reset();
  if (!grid_.geometry().contains(cell)) return;
  if (!grid_.passable(cell)) grid_.open_around(cell, kOpenRadius);
  if (!grid_.passable(cell)) return;
  search_.flood(grid_, cell, std::numeric_limits<double>::infinity());
  flooded_from_ = cell;
}

std::optional<double> PathCosts::pose_cost(const Pose2& robot_in_map, const Pose2& pose_in_map) {
  if (!checker_ || checker_->collides(obstacles_, pose_in_map)) return std::nullopt;
  flood(robot_in_map.position());
  if (!flooded_from_) return std::nullopt;
  const double cost = search_.cost_to_goal(grid_.geometry().cell_of(pose_in_map.position()));
  if (!std::isfinite(cost)) return std::nullopt;
  return cost;
}

CostMatrix PathCosts::matrix(const Pose2& robot_in_map,
                             const std::vector<Eigen::Vector2d>& places_in_map) {
  const std::size_t nodes = places_in_map.size() + 1;
  CostMatrix costs(nodes, std::numeric_limits<double>::infinity());
  const auto place = [&](std::size_t node) {
    return node == 0 ? robot_in_map.position() : places_in_map[node - 1];
  };
  for (std::size_t to = 0; to < nodes; ++to) {
    costs.at(to, to) = 0.0;
    flood(place(to));
    if (!flooded_from_) continue;
    for (std::size_t from = 0; from < nodes; ++from) {
      if (from != to) {
        costs.at(from, to) = search_.cost_to_goal(grid_.geometry().cell_of(place(from)));
      }
    }
  }
  // A blocked place is opened only for its own flood: what leads out of it also leads into it.
  for (std::size_t a = 0; a < nodes; ++a) {
    for (std::size_t b = a + 1; b < nodes; ++b) {
      const double either = std::min(costs.at(a, b), costs.at(b, a));
      costs.at(a, b) = costs.at(b, a) = either;
    }
  }
  return costs;
}

}  // namespace coop::sequencer
