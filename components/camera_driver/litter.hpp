#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace coop::camera_driver {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A floor of litter: brown ground, straw, wood shavings and droppings, the pale ones among them
/// the colour of eggs but smaller. A square that repeats, kept at several sizes of a cell, so that
/// far floor is averaged as a lens does.
class Litter {
 public:
  static constexpr double kCell = 0.004;  ///< m, of level 0; every level doubles it
  static constexpr int kLevels = 4;

  explicit Litter(std::uint64_t seed);

  /// The level whose cell is nearest to `size` m.
  [[nodiscard]] static int level_of(double size);
  /// Colour of the floor at a point, m in world.
  [[nodiscard]] const Colour& at(double x, double y, int level) const {
    const auto& cells = levels_[static_cast<std::size_t>(level)];
    const std::int64_t mask = (kCells >> level) - 1;
    const double scale = 1.0 / (kCell * static_cast<double>(1 << level));
    // Far from the border of a period that lies at zero, truncation rounds down.
    const auto column = static_cast<std::int64_t>(x * scale + kOffset) & mask;
    const auto row = static_cast<std::int64_t>(y * scale + kOffset) & mask;
    return cells[static_cast<std::size_t>(row * (mask + 1) + column)];
  }

 private:
  static constexpr std::int64_t kCells = 1024;  ///< in a row of level 0: a period of 4.1 m
  static constexpr double kOffset = static_cast<double>(kCells << 20);

  std::array<std::vector<Colour>, kLevels> levels_;
};

}  // namespace coop::camera_driver
