#pragma once
#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"

namespace coop::amcl {

/// The free cells of a map, to draw poses from.
class FreeSpace {
 public:
  explicit FreeSpace(const OccupancyGrid& map, int free_percent = 25);

  [[nodiscard]] bool empty() const { return cells_.empty(); }
  [[nodiscard]] double area() const;  ///< m^2

  /// Uniform over the free cells (and within the cell) and over all headings. Not where empty().
  [[nodiscard]] Pose2 draw(RandomStream& random) const;

 private:
  GridGeometry geometry_;
  std::vector<std::uint32_t> cells_;
};

}  // namespace coop::amcl
