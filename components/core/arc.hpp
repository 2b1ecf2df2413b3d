#pragma once
#include <cmath>

namespace coop {

/// Chord over arc length of a circular arc that turns by 2 * `half_turn` (rad).
inline double chord_over_arc(double half_turn) {
  // The series' next term is below 1e-17 here.
  return std::abs(half_turn) < 1e-4 ? 1.0 - half_turn * half_turn / 6.0
                                    : std::sin(half_turn) / half_turn;
}

}  // namespace coop
