#pragma once
#include "core/random.hpp"
#include "global_planner/swarm/four_way.hpp"

namespace coop::global_planner::swarm {

struct AntColonyConfig {
  int ants = 100;            ///< table 8
  int iterations = 500;      ///< table 8
  double pheromone = 1.0;    ///< on every edge at first (table 8); an ant leaves this / steps
  double evaporation = 0.5;  ///< share lost an iteration (table 8)
  double alpha = 1.0;        ///< exponent of pheromone; the paper names no number
  double beta = 2.0;         ///< exponent of visibility; the paper names no number
  double patience = 4.0;     ///< an ant gives up after so many times width + height steps

  void describe(config::Fields& fields);
};

/// ACO on a grid by the CASMA paper's equation 8. Ants go from cell to neighbouring cell, never
/// twice to the same; one that is shut in dies. Visibility is 1 for a step that comes nearer to the
/// goal and 1/3 for one that does not. Each ant that arrives leaves pheromone on its edges. Only
/// whether a cell is passable counts.
class AntColony final : public GridPlanner {
 public:
  AntColony(const AntColonyConfig& config, const RandomStream& random)
      : config_(config), random_(random) {}

  [[nodiscard]] Result<GridPath, SearchFailure> plan(const TraversalGrid& grid, Cell start,
                                                     Cell goal) override;

 private:
  void prepare(const TraversalGrid& grid, Cell goal);
  void weigh();
  /// Whether the ant has arrived; its cells are then in track_.
  bool walk(std::uint32_t start, std::uint32_t goal, std::size_t limit);
  void leave_pheromone();

  AntColonyConfig config_;
  RandomStream random_;
  std::array<std::uint32_t, 4> offsets_{};
  // Four edges of each cell, one after the other.
  std::vector<float> visibility_;  ///< to the power of beta; 0: blocked
  std::vector<float> pheromone_;
  std::vector<float> weight_;           ///< equation 8's product
  std::vector<float> deposit_;          ///< of this iteration
  std::vector<std::uint32_t> visited_;  ///< by which ant last
  std::uint32_t ant_ = 0;
  Track track_;
  Track best_;
};

}  // namespace coop::global_planner::swarm
