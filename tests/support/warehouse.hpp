#pragma once
#include "core/costmap/costmap.hpp"
#include "core/map/map_file.hpp"
#include "support/shared_data.hpp"

namespace coop::test {

/// A warehouse of 1006 x 1674 cells of 3 cm as a costmap.
inline const Costmap* warehouse() {
  static const Costmap* costmap = []() -> const Costmap* {
    const auto path = shared_data("maps/warehouse/warehouse.yaml");
    if (!path) return nullptr;
    const OccupancyGrid map = map::load_map(*path);
    auto* result = new Costmap({}, 0.28);
    result->reset(map.geometry);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      result->obstacles()[i] = map.cells[i] >= 65 ? 1 : 0;
      result->unknown()[i] = map.cells[i] < 0 ? 1 : 0;
    }
    result->update();
    return result;
  }();
  return costmap;
}

}  // namespace coop::test
