#pragma once
#include <Eigen/Core>

#include "core/grid.hpp"

namespace coop::worlds {

/// Paints a world's occupancy grid with shapes in metres. A cell belongs to a shape when its centre
/// lies within it.
class Drawing {
 public:
  /// All unknown. The origin is the lower left corner.
  Drawing(double width, double height, double resolution, const Eigen::Vector2d& origin);

  void box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, std::int8_t value = kOccupied);
  void disc(const Eigen::Vector2d& center, double radius, std::int8_t value = kOccupied);

  [[nodiscard]] const OccupancyGrid& grid() const { return grid_; }

 private:
  template <class Inside>
  void paint(const Inside& inside, std::int8_t value);

  OccupancyGrid grid_;
};

}  // namespace coop::worlds
