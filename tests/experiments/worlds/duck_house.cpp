#include "experiments/worlds/duck_house.hpp"

#include "experiments/worlds/drawing.hpp"

namespace coop::worlds {
namespace {

constexpr double kLength = 14.0;
constexpr double kWidth = 9.0;
constexpr double kWall = 0.15;
constexpr double kMargin = 0.5;  ///< around the house, unknown
constexpr double kBoard = 0.05;  ///< thickness of the nest boxes' boards

void walls(Drawing& house) {
  house.box({-kWall, -kWall}, {kLength + kWall, kWidth + kWall});
  house.box({0, 0}, {kLength, kWidth}, kFree);
  // Door niche in the west wall.
  house.box({-kWall - 0.25, 1.35}, {0, 2.85});
  house.box({-0.25, 1.50}, {0, 2.70}, kFree);
  // Egg store in the south-east corner; its inside is nobody's business.
  house.box({11.4, 0}, {kLength, 2.0});
  house.box({11.5, 0.1}, {kLength - 0.1, 1.9}, kUnknown);
  // Feed silo in the north-east corner.
  house.box({13.1, 7.7}, {kLength, kWidth});
  // Pilasters that carry the roof, at uneven distances.
  house.box({9.2, 0}, {9.4, 0.2});
  house.box({kLength - 0.2, 5.2}, {kLength, 5.4});
  house.box({4.3, kWidth - 0.2}, {4.5, kWidth});
}

/// Boxes side by side, open to the front, from `low` to `high`; `columns` along x or, standing
/// against a side wall, along y.
void nest_boxes_along_x(Drawing& house, double from, double to, double back, double front,
                        double pitch) {
  const double low = std::min(back, front);
  const double high = std::max(back, front);
  for (double x = from; x <= to + 1e-9; x += pitch) house.box({x, low}, {x + kBoard, high});
}

void nest_boxes_along_y(Drawing& house, double from, double to, double back, double front,
                        double pitch) {
  for (double y = from; y <= to + 1e-9; y += pitch) house.box({back, y}, {front, y + kBoard});
}

void furniture(Drawing& house) {
  nest_boxes_along_x(house, 3.6, 7.2, 0.0, 0.45, 0.40);      // nine open boxes, south wall
  nest_boxes_along_x(house, 7.6, 10.6, 8.55, kWidth, 0.50);  // six wider ones, north wall
  nest_boxes_along_y(house, 4.6, 7.0, 0.0, 0.50, 0.40);  // six, west wall, half of them curtained
  house.box({0.45, 4.6}, {0.50, 5.85});
  house.box({2.3, 8.4}, {3.5, kWidth});  // feed bin, north wall
  house.box({5.9, 7.2}, {6.0, kWidth});  // fence from the north wall
  house.box({2.9, 4.45}, {5.3, 4.65});   // line drinker
  house.disc({8.1, 5.6}, 0.25);          // feeder
  house.box({7.5, 2.7}, {7.7, 2.9});     // post
  house.box({10.9, 4.3}, {11.1, 4.5});   // post
}

}  // namespace

OccupancyGrid duck_house() {
  Drawing house(kLength + 2 * kMargin, kWidth + 2 * kMargin, 0.05, {-kMargin, -kMargin});
  walls(house);
  furniture(house);
  return house.grid();
}

}  // namespace coop::worlds
