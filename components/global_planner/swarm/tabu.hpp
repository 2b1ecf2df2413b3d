#pragma once
#include "core/random.hpp"
#include "global_planner/swarm/four_way.hpp"

namespace coop::global_planner::swarm {

struct TabuConfig {
  int tenure = 60;  ///< moves for which a cell that was left stays taboo
  int walks = 20;   ///< of which the shortest is taken

  void describe(config::Fields& fields);
};

/// Taboo search as the CASMA paper sketches it: from each cell to the best neighbour that is not
/// taboo, the cell just left becoming taboo for a while. Best is what lies nearest to the goal;
/// chance decides among equals. Where all neighbours are taboo, the one that has been it the
/// longest is free. Loops are cut out of the walk. Only whether a cell is passable counts.
class Tabu final : public GridPlanner {
 public:
  Tabu(const TabuConfig& config, const RandomStream& random) : config_(config), random_(random) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  bool walk(const TraversalGrid& grid, std::uint32_t start, Cell goal);
  [[nodiscard]] std::uint32_t best_neighbour(const TraversalGrid& grid, std::uint32_t here,
                                             Cell goal, std::int64_t move);

  TabuConfig config_;
  RandomStream random_;
  std::vector<std::int64_t> taboo_until_;  ///< move from which on the cell is free
  Track track_;
  Track best_;
  LoopEraser eraser_;
};

}  // namespace coop::global_planner::swarm
