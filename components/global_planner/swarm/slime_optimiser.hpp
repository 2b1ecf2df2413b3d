#pragma once
#include "global_planner/swarm/optimiser.hpp"
#include "global_planner/swarm/slime_mould.hpp"

namespace coop::global_planner::swarm {

struct SlimeOptimiserConfig {
  PopulationConfig swarm;
  double z = 0.3;  ///< share of individuals placed at random (table 8)
  /// true: equations 6 and 7 to the letter. false: as docs/experiments/casma.md reads them.
  bool as_printed = false;
  int cells = 45;  ///< of the cellular automaton along each dimension; above two: no more cells

  void describe(config::Fields& fields);
};

/// CASMA for functions (table 1 with equations 2 to 7). The automaton's cells divide the first two
/// dimensions of the box; an individual leaves pheromone in the cell it comes to.
class SlimeOptimiser final : public Optimiser {
 public:
  explicit SlimeOptimiser(const SlimeOptimiserConfig& config) : config_(config) {}
  Minimum minimise(Objective& objective, RandomStream& random,
                   std::vector<double>* course) override;

 private:
  void update(Population& moulds, std::size_t i, int iteration, RandomStream& random);
  [[nodiscard]] std::size_t cell_of(Population& moulds, std::size_t i) const;

  SlimeOptimiserConfig config_;
  Ranking ranking_;
  CellPheromone pheromone_;
  std::vector<double> before_;  ///< places at the beginning of the iteration
};

}  // namespace coop::global_planner::swarm
