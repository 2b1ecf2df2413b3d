#pragma once
#include "core/grid.hpp"

namespace coop::worlds {

/// Pens of the pig house: two rows of four, each 5 m x 3 m inside, closed, with an aisle between
/// the rows. They are counted along the southern row from the west, then along the northern one.
inline constexpr int kPens = 8;

/// The pig house of the CASMA paper's figure 14: eight pens of 5 m x 3 m. Where its origin lies is
/// up to the pen the robot works in (1 to kPens): in the south-west corner of that pen's inside, so
/// that a place in a pen has the same coordinates in all eight.
[[nodiscard]] OccupancyGrid pig_house(int pen);

}  // namespace coop::worlds
