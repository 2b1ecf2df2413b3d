#pragma once
#include <optional>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/collision_checker.hpp"
#include "core/costmap/footprint.hpp"
#include "core/search/dijkstra.hpp"
#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer {

/// Real costs of driving, on the costmap that the global planner publishes.
class PathCosts {
 public:
  PathCosts(const Footprint& footprint, const TraversalConfig& traversal);

  /// `costmap` in percent: 100 lethal, 99 inscribed, 1 to 98 restricted, 0 free, -1 unknown.
  void set_costmap(const OccupancyGrid& costmap);
  [[nodiscard]] bool has_costmap() const { return checker_.has_value(); }

  /// Metres of free ground from the robot to the pose; nothing where the footprint does not fit
  /// there or no way leads there. One flood from the robot serves all poses until robot or costmap
  /// change by more than a cell.
  [[nodiscard]] std::optional<double> pose_cost(const Pose2& robot_in_map,
                                                const Pose2& pose_in_map);

  /// Costs from the robot to each place, by one flood; infinite: no way.
  [[nodiscard]] std::vector<double> costs_from(const Pose2& robot_in_map,
                                               const std::vector<Eigen::Vector2d>& places_in_map);

  /// From the robot (node 0) and between all places, by one flood a place (not one a pair). The
  /// cell of an egg is an obstacle itself: the nearest cell that can be driven over stands for it.
  [[nodiscard]] CostMatrix matrix(const Pose2& robot_in_map,
                                  const std::vector<Eigen::Vector2d>& places_in_map);

 private:
  void flood(Cell cell);
  /// The place's cell, or the nearest passable one within the search radius.
  [[nodiscard]] std::optional<Cell> passable_near(const Eigen::Vector2d& place) const;

  Footprint footprint_;
  TraversalGrid grid_;
  DistanceField obstacles_;
  std::optional<CollisionChecker> checker_;
  Dijkstra search_;
  std::optional<Cell> flooded_from_;
};

}  // namespace coop::sequencer
