#include "core/costmap/costmap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coop {
namespace {

constexpr double kRounding = 1e-9;  ///< m: six cells of 0.1 m are not farther than 0.6 m

}  // namespace

void InflationConfig::describe(config::Fields& fields) {
  fields.number("inflation_radius", inflation_radius,
                {.unit = "m",
                 .help = "distance from an obstacle up to which a cell is restricted",
                 .min = 0,
                 .max = 5});
  fields.number("cost_scaling", cost_scaling,
                {.unit = "1/m",
                 .help = "decay of the restricted cost with the distance: larger hugs obstacles",
                 .min = 0.1,
                 .max = 100});
}

Costmap::Costmap(const InflationConfig& config, double inscribed_radius, double max_distance)
    : inscribed_radius_(inscribed_radius),
      max_distance_(std::max(max_distance, config.inflation_radius)),
      config_(config) {}

void Costmap::reset(const GridGeometry& geometry) {
  costs_.geometry = geometry;
  costs_.cells.resize(geometry.size());
  obstacles_.assign(geometry.size(), 0);
  unknown_.assign(geometry.size(), 0);
  complete_ = false;
}

void Costmap::update() {
  // One cell more, so that the cap, which also stands for everything beyond, is a free distance.
  distances_.update(costs_.geometry, obstacles_, max_distance_ + costs_.geometry.resolution);
  make_table();
  color(0, costs_.cells.size());
  complete_ = true;
}

void Costmap::update(std::span<const CellWindow> changed) {
  if (!complete_) return update();
  const GridGeometry& geometry = costs_.geometry;
  for (const CellRun& run : distances_.update_within(changed, obstacles_)) {
    const std::size_t row = geometry.index({0, run.y});
    color(row + static_cast<std::size_t>(run.first), row + static_cast<std::size_t>(run.last));
  }
  for (const CellWindow& window : changed) {  // cells may have become known
    const int first = std::max(0, window.low.x);
    const int last = std::min(geometry.width, window.high.x);
    if (first >= last) continue;
    for (int y = std::max(0, window.low.y); y < std::min(geometry.height, window.high.y); ++y) {
      const std::size_t from = geometry.index({first, y});
      color(from, from + static_cast<std::size_t>(last - first));
    }
  }
}

void Costmap::make_table() {
  const double resolution = costs_.geometry.resolution;
  if (table_resolution_ == resolution) return;
  table_resolution_ = resolution;
  const int cap = distances_.cap();
  cost_of_squared_.assign(static_cast<std::size_t>(cap) * static_cast<std::size_t>(cap) + 1, 0);
  for (std::size_t squared = 0; squared < cost_of_squared_.size(); ++squared) {
    const double distance = std::sqrt(static_cast<double>(squared)) * resolution - kRounding;
    Cost cost = kFreeCost;
    if (squared == 0) {
      cost = kLethalCost;
    } else if (distance <= inscribed_radius_) {
      cost = kInscribedCost;
    } else if (distance <= config_.inflation_radius) {
      const double decay = std::exp(-config_.cost_scaling * (distance - inscribed_radius_));
      cost = static_cast<Cost>(std::max(1.0, std::round(kMaxRestrictedCost * decay)));
    }
    cost_of_squared_[squared] = cost;
  }
}

void Costmap::color(std::size_t first, std::size_t last) {
  const std::int32_t* squared = distances_.squared_cells().data();
  const Cost* table = cost_of_squared_.data();
  const std::uint8_t* unknown = unknown_.data();
  Cost* costs = costs_.cells.data();
  for (std::size_t i = first; i < last; ++i) {
    const Cost cost = table[squared[i]];
    costs[i] = unknown[i] != 0 && cost != kLethalCost ? kUnknownCost : cost;
  }
}

OccupancyGrid to_occupancy(const Grid<Cost>& costs) {
  std::array<std::int8_t, 256> table{};
  for (int cost = 1; cost <= kMaxRestrictedCost; ++cost) {
    table[static_cast<std::size_t>(cost)] =
        static_cast<std::int8_t>(1 + (97 * (cost - 1)) / (kMaxRestrictedCost - 1));
  }
  table[kInscribedCost] = 99;
  table[kLethalCost] = kOccupied;
  table[kUnknownCost] = kUnknown;
  OccupancyGrid result(costs.geometry, kFree);
  std::transform(costs.cells.begin(), costs.cells.end(), result.cells.begin(),
                 [&table](Cost cost) { return table[cost]; });
  return result;
}

}  // namespace coop
