#pragma once
#include "core/grid.hpp"

namespace coop::worlds {

/// A duck house of 14 m x 9 m inside, origin of the frame in its south-west corner: nest boxes
/// along three walls, posts, drinkers, a fence, the egg store. No two corners look alike, and
/// free-standing things leave aisles of at least 2.2 m.
[[nodiscard]] OccupancyGrid duck_house();

}  // namespace coop::worlds
