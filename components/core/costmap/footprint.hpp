#pragma once
#include <Eigen/Core>
#include <vector>

namespace coop {

/// The robot's outline on the floor: a convex polygon, counter-clockwise, in base_link, that holds
/// the origin of base_link. All lengths in metres.
class Footprint {
 public:
  /// `padding` pushes every edge outwards (inwards where negative). Throws std::invalid_argument
  /// where the polygon is not convex and counter-clockwise or does not hold the origin after
  /// padding.
  explicit Footprint(std::vector<Eigen::Vector2d> vertices, double padding = 0.0);

  [[nodiscard]] const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  /// Radius of the largest disc about base_link inside the outline: with an obstacle nearer than
  /// that a collision is inevitable, whatever the heading.
  [[nodiscard]] double inscribed_radius() const { return inscribed_radius_; }
  /// Radius of the smallest disc about base_link around the outline: with every obstacle farther
  /// than that no heading collides.
  [[nodiscard]] double circumscribed_radius() const { return circumscribed_radius_; }
  /// Smaller extent to the left and right: the free space a robot needs on each side of a line it
  /// drives along.
  [[nodiscard]] double half_width() const { return half_width_; }
  [[nodiscard]] const Eigen::Vector2d& lower() const { return lower_; }  ///< of the bounding box
  [[nodiscard]] const Eigen::Vector2d& upper() const { return upper_; }

  [[nodiscard]] bool contains(const Eigen::Vector2d& point) const;
  /// Distance of the outline from a point inside it; negative outside, where it is only a lower
  /// bound of the distance.
  [[nodiscard]] double depth(const Eigen::Vector2d& point) const;

 private:
  std::vector<Eigen::Vector2d> vertices_;
  Eigen::Vector2d lower_;
  Eigen::Vector2d upper_;
  double inscribed_radius_ = 0.0;
  double circumscribed_radius_ = 0.0;
  double half_width_ = 0.0;
};

}  // namespace coop
