#pragma once
#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/costmap/distance_field.hpp"
#include "core/costmap/footprint.hpp"
#include "core/pose.hpp"

namespace coop {

/// Whether the footprint at a pose covers an obstacle cell. The footprint is halved again and again
/// into boxes, down to half a cell; a box whose middle is far from every obstacle is free with all
/// its parts after one look into the distance field, so that most poses cost one to ten look-ups.
/// The answer is that of sampling the polygon every half cell.
class CollisionChecker {
 public:
  /// A pose with the cosine and sine of its heading, for callers that know them.
  struct Placement {
    double x;
    double y;
    double cosine;
    double sine;
  };
  [[nodiscard]] static Placement place(const Pose2& pose) {
    return {pose.x, pose.y, std::cos(pose.yaw), std::sin(pose.yaw)};
  }

  /// For distance fields of that resolution, whose cap must exceed reach().
  CollisionChecker(const Footprint& footprint, double resolution);

  /// Half the diagonal of the footprint's bounding box and two cells, m.
  [[nodiscard]] double reach() const { return reach_; }

  /// Cells beyond the border of the field count as obstacles. No allocation.
  [[nodiscard]] bool collides(const DistanceField& field, const Placement& placement) const;
  [[nodiscard]] bool collides(const DistanceField& field, const Pose2& pose_in_field) const {
    return collides(field, place(pose_in_field));
  }

  /// Distance in metres between the footprint and the nearest obstacle, from discs along its middle
  /// axis: exact at the flanks, up to 0.42 half widths too large at the corners; negative where an
  /// obstacle lies inside; never beyond the field's cap. For costs, not for safety.
  [[nodiscard]] double clearance(const DistanceField& field, const Placement& placement) const;
  [[nodiscard]] double clearance(const DistanceField& field, const Pose2& pose_in_field) const {
    return clearance(field, place(pose_in_field));
  }

 private:
  struct Box {
    double x;  ///< middle in base_link, m
    double y;  ///< middle in base_link, m
    std::int32_t
        free_from;  ///< squared cells: with the obstacles at least this far the box is free
    std::int32_t
        hit_up_to;  ///< squared cells: with an obstacle this near the footprint is hit; -1: never
    std::int32_t skip;  ///< index of the next box that is no part of this one
  };

  void divide(const Footprint& footprint, const Eigen::Vector2d& lower,
              const Eigen::Vector2d& upper, double resolution);

  std::vector<Eigen::Vector2d> corners_;
  double radius_;           ///< of the disc about base_link around them
  std::vector<Box> boxes_;  ///< a box stands before its parts
  std::vector<double> axis_;
  double axis_y_ = 0.0;
  double axis_radius_ = 0.0;
  double reach_ = 0.0;
};

}  // namespace coop
