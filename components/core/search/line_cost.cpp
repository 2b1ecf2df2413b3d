#include "core/search/line_cost.hpp"

#include <cmath>
#include <cstdlib>

namespace coop {

double line_cost(const TraversalGrid& grid, Cell from, Cell to, double limit) {
  constexpr double kBlockedLine = std::numeric_limits<double>::infinity();
  const std::int64_t dx = std::abs(to.x - from.x);
  const std::int64_t dy = std::abs(to.y - from.y);
  const int along_x = to.x > from.x ? 1 : -1;
  const int along_y = to.y > from.y ? grid.stride() : -grid.stride();
  const double length = std::sqrt(static_cast<double>(dx * dx + dy * dy));
  const std::span<const Cost> cells = grid.cells();
  const std::array<float, 256>& factors = grid.factors();
  auto index = static_cast<std::int64_t>(grid.padded_index(from));
  const auto factor_at = [&](std::int64_t at) {
    return factors[cells[static_cast<std::size_t>(at)]];
  };
  double cost = 0.0;
  double entered = 0.0;  // share of the line before the present cell
  // The line leaves its (i+1)-th column at the share (2i + 1) / 2dx, rows alike; compared as
  // integers.
  std::int64_t odd_x = 1;
  std::int64_t odd_y = 1;
  while (odd_x < 2 * dx || odd_y < 2 * dy) {
    const std::int64_t leaves_column =
        dx == 0 ? std::numeric_limits<std::int64_t>::max() : odd_x * dy;
    const std::int64_t leaves_row = dy == 0 ? std::numeric_limits<std::int64_t>::max() : odd_y * dx;
    const double factor = factor_at(index);
    double left = 0.0;
    if (leaves_column == leaves_row) {
      left = static_cast<double>(odd_x) / static_cast<double>(2 * dx);
      if (factor_at(index + along_x) + factor_at(index + along_y) == TraversalGrid::kBlocked) {
        return kBlockedLine;
      }
      index += along_x + along_y;
      odd_x += 2;
      odd_y += 2;
    } else if (leaves_column < leaves_row) {
      left = static_cast<double>(odd_x) / static_cast<double>(2 * dx);
      index += along_x;
      odd_x += 2;
    } else {
      left = static_cast<double>(odd_y) / static_cast<double>(2 * dy);
      index += along_y;
      odd_y += 2;
    }
    cost += factor * (left - entered);
    entered = left;
    if (factor_at(index) == TraversalGrid::kBlocked || cost * length > limit) return kBlockedLine;
  }
  cost = (cost + factor_at(index) * (1.0 - entered)) * length;
  return cost > limit ? kBlockedLine : cost;
}

}  // namespace coop
