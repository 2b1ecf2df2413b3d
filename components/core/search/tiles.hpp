#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
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
    const Cell& first = first_cells_[index / kTile];
    return {first.x + static_cast<int>(index % kSide),
            first.y + static_cast<int>(index % kTile / kSide)};
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

  /// The same for all eight neighbours, anticlockwise from east. Precondition as above.
  using Ring = std::array<std::uint32_t, 8>;
  [[nodiscard]] Ring ring(std::uint32_t index) const {
    const Around to = around(index);
    return {to.east, to.north + to.east, to.north, to.north + to.west,
            to.west, to.south + to.west, to.south, to.south + to.east};
  }
  /// That of the cells whose neighbours lie in the same tile, which most do.
  static constexpr Ring kInnerRing{1U,      kSide + 1U,      kSide,      kSide - 1U,
                                   0U - 1U, 0U - kSide - 1U, 0U - kSide, 0U - kSide + 1U};
  [[nodiscard]] static bool has_inner_ring(std::uint32_t index) {
    return index % kSide - 1U < kSide - 2U && index / kSide % kSide - 1U < kSide - 2U;
  }

  /// Whether a cell and its eight neighbours all cost the same.
  [[nodiscard]] bool alike(std::uint32_t index, const Ring& ring) const {
    std::uint32_t different = 0;
    for (const std::uint32_t to : ring) different |= cells_[index + to] ^ cells_[index];
    return different == 0;
  }
  /// The same for a cell with the inner ring, three cells at a time.
  [[nodiscard]] bool alike_inside(std::uint32_t index) const {
    using Four = std::array<Cost, 4>;
    const auto row = [&](std::uint32_t middle) {
      Four four;
      std::memcpy(four.data(), &cells_[middle - 1U], 4);
      return std::bit_cast<std::uint32_t>(four);
    };
    const Cost own = cells_[index];
    const auto alike = std::bit_cast<std::uint32_t>(Four{own, own, own, 0});
    constexpr auto kThree = std::bit_cast<std::uint32_t>(Four{255, 255, 255, 0});
    const std::uint32_t different =
        (row(index) ^ alike) | (row(index + kSide) ^ alike) | (row(index - kSide) ^ alike);
    return (different & kThree) == 0;
  }

 private:
  std::vector<Cost> cells_;
  std::vector<Cell> first_cells_;       ///< of each tile
  std::uint32_t row_of_tiles_ = kTile;  ///< cells in a row of tiles
  std::uint64_t revision_ = 0;
};

}  // namespace coop::search
