#include "core/search/grid_planner.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace coop {
namespace {

/// Stands for an inscribed cell opened for a search; kInscribedCost itself is blocked.
constexpr Cost kOpenedCost = kMaxRestrictedCost;

/// Counts states of grids, of all threads; nothing but equality is ever asked of the numbers.
std::uint64_t next_revision() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

void TraversalConfig::describe(config::Fields& fields) {
  fields.number("restricted_weight", restricted_weight,
                {.unit = "m/m",
                 .help = "extra cost of a metre through the most restricted cells",
                 .min = 0,
                 .max = 100});
  fields.number(
      "unknown_weight", unknown_weight,
      {.unit = "m/m", .help = "extra cost of a metre through unknown cells", .min = 0, .max = 100});
  fields.flag("allow_unknown", allow_unknown,
              {.help = "whether paths may lead through cells nobody has seen"});
}

TraversalGrid::TraversalGrid(const TraversalConfig& config) : revision_(next_revision()) {
  for (int cost = 0; cost <= kMaxRestrictedCost; ++cost) {
    factors_[static_cast<std::size_t>(cost)] =
        static_cast<float>(1.0 + config.restricted_weight * cost / kMaxRestrictedCost);
  }
  factors_[kInscribedCost] = kBlocked;
  factors_[kLethalCost] = kBlocked;
  factors_[kUnknownCost] =
      config.allow_unknown ? static_cast<float>(1.0 + config.unknown_weight) : kBlocked;
  for (const float factor : factors_) {
    if (factor < kBlocked) largest_factor_ = std::max(largest_factor_, factor);
  }
}

void TraversalGrid::update(const Grid<Cost>& costs) {
  revision_ = next_revision();
  geometry_ = costs.geometry;
  opened_.clear();
  const auto width = static_cast<std::size_t>(geometry_.width);
  cells_.assign((width + 2) * (static_cast<std::size_t>(geometry_.height) + 2), kLethalCost);
  for (int y = 0; y < geometry_.height; ++y) {
    std::copy_n(costs.cells.begin() + static_cast<std::ptrdiff_t>(costs.geometry.index({0, y})),
                width, cells_.begin() + static_cast<std::ptrdiff_t>(padded_index({0, y})));
  }
}

void TraversalGrid::open_around(Cell cell, double radius) {
  revision_ = next_revision();
  const int reach = static_cast<int>(radius / geometry_.resolution);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const Cell near{cell.x + dx, cell.y + dy};
      if (dx * dx + dy * dy > reach * reach || !geometry_.contains(near)) continue;
      const std::uint32_t index = padded_index(near);
      if (cells_[index] != kInscribedCost) continue;
      cells_[index] = kOpenedCost;
      opened_.push_back(index);
    }
  }
}

void TraversalGrid::close() {
  revision_ = next_revision();
  for (const std::uint32_t index : opened_) cells_[index] = kInscribedCost;
  opened_.clear();
}

std::string_view to_string(SearchFailure failure) {
  switch (failure) {
    case SearchFailure::kStartBlocked:
      return "the start is blocked";
    case SearchFailure::kGoalBlocked:
      return "the goal is blocked";
    case SearchFailure::kNoPath:
      return "no path leads from the start to the goal";
    case SearchFailure::kStartOutside:
      return "the start lies outside the grid";
    case SearchFailure::kGoalOutside:
      return "the goal lies outside the grid";
    case SearchFailure::kEmptyGrid:
      return "the grid has no cells";
    case SearchFailure::kCostsDiffer:
      return "this planner needs a grid whose passable cells all cost the same";
  }
  return "unknown reason";
}

std::optional<SearchFailure> check_ends(const TraversalGrid& grid, Cell start, Cell goal) {
  const GridGeometry& geometry = grid.geometry();
  if (geometry.width <= 0 || geometry.height <= 0) return SearchFailure::kEmptyGrid;
  if (!geometry.contains(goal)) return SearchFailure::kGoalOutside;
  if (!geometry.contains(start)) return SearchFailure::kStartOutside;
  if (!grid.passable(goal)) return SearchFailure::kGoalBlocked;
  if (!grid.passable(start)) return SearchFailure::kStartBlocked;
  return std::nullopt;
}

std::optional<Cell> cell_within(const GridGeometry& geometry, const Eigen::Vector2d& point) {
  const Eigen::Vector2d cells = (point - geometry.origin) / geometry.resolution;
  // Written so that a NaN is outside; what is inside fits into an int.
  const bool inside = cells.x() >= 0.0 && cells.x() < geometry.width && cells.y() >= 0.0 &&
                      cells.y() < geometry.height;
  if (!inside) return std::nullopt;
  return Cell{static_cast<int>(cells.x()), static_cast<int>(cells.y())};
}

double cost_of(const TraversalGrid& grid, std::span<const Cell> path) {
  double cost = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Cell from = path[i - 1];
    const Cell to = path[i];
    const double length = from.x != to.x && from.y != to.y ? std::numbers::sqrt2 : 1.0;
    cost +=
        length * 0.5 * (grid.factor(grid.padded_index(from)) + grid.factor(grid.padded_index(to)));
  }
  return cost * grid.geometry().resolution;
}

}  // namespace coop
