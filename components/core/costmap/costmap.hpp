#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/distance_field.hpp"
#include "core/grid.hpp"

namespace coop {

/// Cost of a cell for base_link, in the zones of the egg paper's figure 3: free (0), restricted (1
/// to 252, a collision depends on the heading), inscribed (a collision is inevitable), lethal (an
/// obstacle is there), and unknown.
using Cost = std::uint8_t;
inline constexpr Cost kFreeCost = 0;
inline constexpr Cost kMaxRestrictedCost = 252;
inline constexpr Cost kInscribedCost = 253;
inline constexpr Cost kLethalCost = 254;
inline constexpr Cost kUnknownCost = 255;

enum class Zone : std::uint8_t {
  kFreeZone,
  kRestrictedZone,
  kInscribedZone,
  kLethalZone,
  kUnknownZone
};

[[nodiscard]] constexpr Zone zone_of(Cost cost) {
  if (cost == kUnknownCost) return Zone::kUnknownZone;
  if (cost == kLethalCost) return Zone::kLethalZone;
  if (cost == kInscribedCost) return Zone::kInscribedZone;
  return cost == kFreeCost ? Zone::kFreeZone : Zone::kRestrictedZone;
}

struct InflationConfig {
  double inflation_radius =
      1.0;                    ///< m from an obstacle's middle: up to here the zone is restricted
  double cost_scaling = 4.0;  ///< 1/m: cost = 252 exp(-cost_scaling (distance - inscribed radius))

  void describe(config::Fields& fields);
};

/// Obstacles and unknown cells, their distance field, and the cost of every cell: the four zones
/// come from the distance to the nearest obstacle alone, so layers only have to agree on which
/// cells are obstacles.
class Costmap {
 public:
  /// `inscribed_radius` in metres. Distances are measured up to the larger of the inflation radius
  /// and `max_distance` (m), the reach of the collision check.
  Costmap(const InflationConfig& config, double inscribed_radius, double max_distance = 0.0);

  /// Layers write into obstacles() and unknown() (0 or 1 a cell) after reset(), then update()
  /// computes field and costs.
  void reset(const GridGeometry& geometry);
  [[nodiscard]] std::span<std::uint8_t> obstacles() { return obstacles_; }
  [[nodiscard]] std::span<std::uint8_t> unknown() { return unknown_; }
  void update();
  /// The same result as update() to the bit, where obstacles() and unknown() have changed since the
  /// last update within these windows only; costs in proportion to what they change.
  void update(std::span<const CellWindow> changed);

  [[nodiscard]] const GridGeometry& geometry() const { return costs_.geometry; }
  [[nodiscard]] const Grid<Cost>& costs() const { return costs_; }
  [[nodiscard]] const DistanceField& distances() const { return distances_; }
  /// Lethal beyond the border.
  [[nodiscard]] Cost cost_at(Cell cell) const { return costs_.at_or(cell, kLethalCost); }
  [[nodiscard]] std::span<const std::uint8_t> obstacles() const { return obstacles_; }

 private:
  void make_table();
  void color(std::size_t first, std::size_t last);

  double inscribed_radius_;
  double max_distance_;
  InflationConfig config_;
  std::vector<std::uint8_t> obstacles_;
  std::vector<std::uint8_t> unknown_;
  DistanceField distances_;
  Grid<Cost> costs_;
  std::vector<Cost> cost_of_squared_;  ///< index: squared cells
  double table_resolution_ = 0.0;
  bool complete_ = false;  ///< update() has run since reset()
};

/// For people and recorders, as ROS draws costmaps: 0 free, 1 to 98 restricted, 99 inscribed, 100
/// lethal, -1 unknown.
[[nodiscard]] OccupancyGrid to_occupancy(const Grid<Cost>& costs);

}  // namespace coop
