#include "core/search/grid_planner.hpp"

#include <algorithm>
#include <cmath>

namespace coop {
namespace {

/// Stands for an inscribed cell opened for a search; kInscribedCost itself is blocked.
constexpr Cost kOpenedCost = kMaxRestrictedCost;

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

TraversalGrid::TraversalGrid(const TraversalConfig& config) {
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
  for (const std::uint32_t index : opened_) cells_[index] = kInscribedCost;
  opened_.clear();
}

}  // namespace coop
