#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/search/grid_planner.hpp"

namespace coop::search {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kDiagonal = std::numbers::sqrt2_v<float>;

/// The cells of a traversal grid, its border of blocked cells included, in square tiles. A wave
/// front runs across rows as often as along them: with whole rows one behind the other it touches a
/// page of memory a row, with tiles one in 32 (bench core_search, full wave: a quarter of the run).
class Tiles {
 public:
  static constexpr std::uint32_t kSide = 32;
  static constexpr std::uint32_t kTile = kSide * kSide;

  /// Copies the grid's cells where they have changed since the last call; true where they had.
  bool update(const TraversalGrid& grid);

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] const Cost* cells() const { return cells_.data(); }
  [[nodiscard]] std::uint32_t index(Cell cell) const {
    const auto x = static_cast<std::uint32_t>(cell.x + 1);
    const auto y = static_cast<std::uint32_t>(cell.y + 1);
    return (y / kSide) * row_of_tiles_ + (x / kSide) * kTile + (y % kSide) * kSide + x % kSide;
  }
  [[nodiscard]] Cell cell_at(std::uint32_t index) const {
    const std::uint32_t row = index / row_of_tiles_;
    const std::uint32_t tile = (index - row * row_of_tiles_) / kTile;
    return {static_cast<int>(tile * kSide + index % kSide) - 1,
            static_cast<int>(row * kSide + index % kTile / kSide) - 1};
  }

  /// What to add to a cell's index (modulo 2^32) to get to the next one in each direction; a
  /// diagonal step is the sum of two. Precondition: the cell is not of the border.
  struct Around {
    std::uint32_t east, west, north, south;
  };
  [[nodiscard]] Around around(std::uint32_t index) const {
    constexpr std::uint32_t kLastRow = kTile - kSide;
    constexpr std::uint32_t kToTile = kTile - kSide + 1;  // from the last column to the next tile
    const std::uint32_t x = index % kSide;
    const std::uint32_t row = index & kLastRow;
    const std::uint32_t to_row = row_of_tiles_ - kLastRow;
    return {x == kSide - 1 ? kToTile : 1U, x == 0 ? 0U - kToTile : 0U - 1U,
            row == kLastRow ? to_row : kSide, row == 0 ? 0U - to_row : 0U - kSide};
  }

 private:
  std::vector<Cost> cells_;
  std::uint32_t row_of_tiles_ = kTile;  ///< cells in a row of tiles
  std::uint64_t revision_ = 0;
};

}  // namespace coop::search
