#include "experiments/worlds/drawing.hpp"

#include <cmath>

namespace coop::worlds {

Drawing::Drawing(double width, double height, double resolution, const Eigen::Vector2d& origin)
    : grid_({static_cast<int>(std::lround(width / resolution)),
             static_cast<int>(std::lround(height / resolution)), resolution, origin},
            kUnknown) {}

template <class Inside>
void Drawing::paint(const Inside& inside, std::int8_t value) {
  for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
    if (inside(grid_.geometry.center_of(grid_.geometry.cell_at(i)))) grid_.cells[i] = value;
  }
}

void Drawing::box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, std::int8_t value) {
  paint(
      [&](const Eigen::Vector2d& p) {
        return p.x() > low.x() && p.x() < high.x() && p.y() > low.y() && p.y() < high.y();
      },
      value);
}

void Drawing::disc(const Eigen::Vector2d& center, double radius, std::int8_t value) {
  paint([&](const Eigen::Vector2d& p) { return (p - center).norm() < radius; }, value);
}

}  // namespace coop::worlds
