#pragma once
#include "global_planner/swarm/optimiser.hpp"

namespace coop::global_planner::swarm {

struct FirefliesConfig {
  PopulationConfig swarm;
  double gamma = 1.0;     ///< decay of light (table 8), for distances with the box's sides as 1
  double alpha = 0.2;     ///< of the random step (table 8), in sides of the box
  double beta = 1.0;      ///< attraction at no distance; the paper names no number
  double cooling = 0.98;  ///< alpha's factor an iteration; 1: equation 11 as it stands
  /// true: equation 11 as printed, where brighter fireflies repel.
  bool as_printed = false;

  void describe(config::Fields& fields);
};

/// FA (the paper's equation 11): each firefly goes towards every brighter one, then is judged.
class Fireflies final : public Optimiser {
 public:
  explicit Fireflies(const FirefliesConfig& config) : config_(config) {}
  Minimum minimise(Objective& objective, RandomStream& random,
                   std::vector<double>* course) override;

 private:
  void attract(Population& flies, std::size_t i, double alpha, RandomStream& random) const;

  FirefliesConfig config_;
};

}  // namespace coop::global_planner::swarm
