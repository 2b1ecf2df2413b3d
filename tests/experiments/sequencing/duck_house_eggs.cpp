#include "experiments/sequencing/duck_house_eggs.hpp"

#include <cmath>

#include "core/map/map_file.hpp"
#include "core/random.hpp"
#include "sequencer/sequencer.hpp"

namespace coop::experiments {

sequencer::PathCosts duck_house_costs() {
  const OccupancyGrid house = map::load_map(COOP_SOURCE_DIR "/maps/duck_house.yaml");
  const Footprint robot({{-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}});
  Costmap costmap({}, robot.inscribed_radius());
  costmap.reset(house.geometry);
  for (std::size_t i = 0; i < house.cells.size(); ++i) {
    costmap.obstacles()[i] = house.cells[i] >= 65 ? 1 : 0;
    costmap.unknown()[i] = house.cells[i] < 0 ? 1 : 0;
  }
  costmap.update();
  sequencer::PathCosts costs(robot, sequencer::SequencerConfig{}.traversal);
  costs.set_costmap(to_occupancy(costmap.costs()));
  return costs;
}

std::vector<Eigen::Vector2d> duck_house_eggs(sequencer::PathCosts& costs, std::size_t count,
                                             std::uint64_t seed) {
  RandomStream random(seed, "eggs");
  std::vector<Eigen::Vector2d> eggs;
  while (eggs.size() < count) {
    const Eigen::Vector2d egg(random.uniform(1.0, 13.0), random.uniform(0.9, 8.1));
    if (std::isfinite(costs.costs_from(kDuckHouseStart, {egg}).front())) eggs.push_back(egg);
  }
  return eggs;
}

}  // namespace coop::experiments
