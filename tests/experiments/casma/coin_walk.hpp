#pragma once
#include "core/random.hpp"
#include "core/search/grid_planner.hpp"
#include "global_planner/swarm/four_way.hpp"

namespace coop::casma {

/// The yardstick for how hard a map is: at each cell a coin chooses between the two directions that
/// come nearer to the goal. Where neither is free the walk is lost and another begins. What arrives
/// has taken the fewest steps there can be.
class CoinWalk final : public GridPlanner {
 public:
  CoinWalk(int walks, const RandomStream& random) : walks_(walks), random_(random) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  bool walk(const TraversalGrid& grid, Cell start, Cell goal);

  int walks_;
  RandomStream random_;
  global_planner::swarm::Track track_;
};

}  // namespace coop::casma
