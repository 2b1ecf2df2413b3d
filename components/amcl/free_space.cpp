#include "amcl/free_space.hpp"

#include <numbers>

namespace coop::amcl {

FreeSpace::FreeSpace(const OccupancyGrid& map, int free_percent) : geometry_(map.geometry) {
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const int occupancy = map.cells[i];
    if (occupancy >= 0 && occupancy <= free_percent) {
      cells_.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

double FreeSpace::area() const {
  return static_cast<double>(cells_.size()) * geometry_.resolution * geometry_.resolution;
}

Pose2 FreeSpace::draw(RandomStream& random) const {
  const Cell cell = geometry_.cell_at(cells_[random.below(cells_.size())]);
  const double half = geometry_.resolution / 2.0;
  const Eigen::Vector2d center = geometry_.center_of(cell);
  const double x = center.x() + random.uniform(-half, half);
  const double y = center.y() + random.uniform(-half, half);
  return {x, y, random.uniform(-std::numbers::pi, std::numbers::pi)};
}

}  // namespace coop::amcl
