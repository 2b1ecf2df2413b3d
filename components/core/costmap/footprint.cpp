#include "core/costmap/footprint.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace coop {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Where the two edges that meet in `corner`, both pushed outwards by `padding`, meet.
Eigen::Vector2d pushed_corner(const Eigen::Vector2d& before, const Eigen::Vector2d& corner,
                              const Eigen::Vector2d& after, double padding) {
  const Eigen::Vector2d in = (corner - before).normalized();
  const Eigen::Vector2d out = (after - corner).normalized();
  const Eigen::Vector2d normal_in(in.y(), -in.x());
  const Eigen::Vector2d normal_out(out.y(), -out.x());
  return corner + padding / (1.0 + normal_in.dot(normal_out)) * (normal_in + normal_out);
}

}  // namespace

Footprint::Footprint(std::vector<Eigen::Vector2d> vertices, double padding) {
  const std::size_t n = vertices.size();
  if (n < 3) throw std::invalid_argument("footprint: needs at least three corners");
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& before = vertices[(i + n - 1) % n];
    const Eigen::Vector2d& after = vertices[(i + 1) % n];
    if (!(cross(vertices[i] - before, after - vertices[i]) > 0.0)) {
      throw std::invalid_argument("footprint: must be convex, corners counter-clockwise");
    }
    vertices_.push_back(pushed_corner(before, vertices[i], after, padding));
  }
  inscribed_radius_ = depth(Eigen::Vector2d::Zero());
  if (!(inscribed_radius_ > 0.0)) {
    throw std::invalid_argument("footprint: base_link must lie inside");
  }
  lower_ = upper_ = vertices_.front();
  for (const Eigen::Vector2d& vertex : vertices_) {
    lower_ = lower_.cwiseMin(vertex);
    upper_ = upper_.cwiseMax(vertex);
    circumscribed_radius_ = std::max(circumscribed_radius_, vertex.norm());
  }
  half_width_ = std::min(upper_.y(), -lower_.y());
}

double Footprint::depth(const Eigen::Vector2d& point) const {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Eigen::Vector2d& from = vertices_[i];
    const Eigen::Vector2d edge = vertices_[(i + 1) % vertices_.size()] - from;
    smallest = std::min(smallest, cross(edge, point - from) / edge.norm());
  }
  return smallest;
}

bool Footprint::contains(const Eigen::Vector2d& point) const {
  return depth(point) >= 0.0;
}

}  // namespace coop
