#include "experiments/worlds/pig_house.hpp"

#include "experiments/worlds/drawing.hpp"

namespace coop::worlds {
namespace {

constexpr int kPensInRow = 4;
constexpr double kLength = 5.0;  ///< of a pen, along x, m
constexpr double kWidth = 3.0;   ///< of a pen, along y, m
constexpr double kWall = 0.10;
constexpr double kAisle = 1.20;   ///< between the rows
constexpr double kMargin = 0.25;  ///< around the house, unknown

/// South-west corner of a pen's inside, in the frame of pen 1.
Eigen::Vector2d corner_of(int pen) {
  const int index = pen - 1;
  return {(index % kPensInRow) * (kLength + kWall),
          (index / kPensInRow) * (kWidth + 2 * kWall + kAisle)};
}

}  // namespace

OccupancyGrid pig_house(int pen) {
  const Eigen::Vector2d size(kPensInRow * (kLength + kWall) + kWall,
                             2 * (kWidth + 2 * kWall) + kAisle);
  const Eigen::Vector2d corner = -Eigen::Vector2d(kWall, kWall) - corner_of(pen);
  const Eigen::Vector2d margin(kMargin, kMargin);
  const Eigen::Vector2d whole = size + 2 * margin;
  // Whole cells of 1/20 m, so that the origin is the number that the file says.
  const Eigen::Vector2d origin = (20.0 * (corner - margin)).array().round() / 20.0;
  Drawing house(whole.x(), whole.y(), 0.05, origin);
  house.box(corner, corner + size);
  for (int other = 1; other <= kPens; ++other) {
    const Eigen::Vector2d low = corner_of(other) - corner_of(pen);
    house.box(low, low + Eigen::Vector2d(kLength, kWidth), kFree);
  }
  const Eigen::Vector2d aisle = Eigen::Vector2d(0.0, kWidth + kWall) - corner_of(pen);
  house.box(aisle, aisle + Eigen::Vector2d(size.x() - 2 * kWall, kAisle), kFree);
  return house.grid();
}

}  // namespace coop::worlds
