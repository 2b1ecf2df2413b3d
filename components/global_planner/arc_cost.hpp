#pragma once
#include <limits>

#include "core/config/fields.hpp"
#include "core/costmap/collision_checker.hpp"
#include "core/pose.hpp"
#include "core/search/grid_planner.hpp"
#include "global_planner/pose_checker.hpp"
#include "global_planner/reeds_shepp.hpp"

namespace coop::global_planner {

/// What driving an arc costs, in metres of free ground.
struct ArcCostConfig {
  double reverse_weight = 1.4;    ///< of a metre driven backwards
  double cusp_cost = 0.8;         ///< m for each change of direction
  double turn_weight = 0.10;      ///< extra for a metre at the smallest radius
  double steering_cost = 0.10;    ///< m for steering from straight to the smallest radius
  double clearance = 0.25;        ///< m of free space beside the padded footprint wished for
  double clearance_weight = 3.0;  ///< extra for a metre driven without any

  void describe(config::Fields& fields);
};

/// Prices arcs over a traversal grid and checks them for collisions.
class ArcCost {
 public:
  ArcCost(const ArcCostConfig& config, double turning_radius)
      : config_(config), radius_(turning_radius) {}

  struct Start {
    Pose2 pose;
    CollisionChecker::Placement placement;  ///< of that pose
  };
  struct Driven {
    double cost = std::numeric_limits<double>::infinity();  ///< infinite: it collides
    Start end{};                                            ///< only where it does not
    [[nodiscard]] bool free() const { return cost < std::numeric_limits<double>::infinity(); }
  };

  /// At least abs(arc.length) where free.
  [[nodiscard]] Driven drive(const TraversalGrid& grid, const PoseChecker& poses,
                             const Start& start, const Arc& arc) const;

  /// Between two arcs: for steering, and for a change of direction. `direction` 0: at rest.
  [[nodiscard]] double change(int direction, double curvature, const Arc& next) const;

 private:
  ArcCostConfig config_;
  double radius_;
};

}  // namespace coop::global_planner
