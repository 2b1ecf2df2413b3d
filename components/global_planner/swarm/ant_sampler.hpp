#pragma once
#include "global_planner/swarm/optimiser.hpp"

namespace coop::global_planner::swarm {

struct AntSamplerConfig {
  PopulationConfig swarm;
  double pheromone = 1.0;    ///< at first (table 8)
  double evaporation = 0.5;  ///< share lost an iteration (table 8)
  int levels = 400;          ///< values a dimension may take

  void describe(config::Fields& fields);
};

/// ACO for functions: equation 8 chooses among nodes, so each dimension becomes a row of nodes, its
/// levels, and an ant passes one in every row. There is no visibility (eta = 1) and alpha is 1.
/// The best ant of an iteration and the best ever leave pheromone.
class AntSampler final : public Optimiser {
 public:
  explicit AntSampler(const AntSamplerConfig& config) : config_(config) {}
  Minimum minimise(Objective& objective, RandomStream& random,
                   std::vector<double>* course) override;

 private:
  [[nodiscard]] std::size_t choose(std::size_t dimension, RandomStream& random) const;
  void leave(const std::vector<std::size_t>& levels);
  void sum_up();

  AntSamplerConfig config_;
  std::vector<double> pheromone_;  ///< a row of levels for each dimension
  std::vector<double> sums_;       ///< of the rows from their beginning on
};

}  // namespace coop::global_planner::swarm
