#pragma once
#include "core/config/fields.hpp"
#include "core/random.hpp"
#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer {

struct MaxMinConfig {
  int ants = 10;         ///< an iteration
  int iterations = 200;  ///< the only bound of time: each run of a seed is the same, to the bit
  int neighbours = 10;   ///< of each place, among which ants and local search choose
  double alpha = 1.0;    ///< importance of pheromone
  double beta = 2.0;     ///< importance of 1 / distance
  double rho = 0.2;      ///< evaporation an iteration
  int patience = 30;     ///< iterations without a better tour until the trails begin anew

  void describe(config::Fields& fields);
};

/// The order of collecting by MAX-MIN ants (Stuetzle, Hoos 2000): pheromone lies between bounds,
/// on edges to neighbours only; only the best ant leaves some; every ant's tour goes through local
/// search (2-opt, 3-opt, moving of segments) first; where nothing better comes for a while the
/// trails begin anew. Open or closed, symmetric or not (see TourProblem).
///
/// Time and memory: n^2 doubles and `ants * iterations` tours of n places, no more.
/// Precondition: costs are finite and not negative.
[[nodiscard]] Tour solve_by_max_min_ants(const CostMatrix& costs, bool closed,
                                         const MaxMinConfig& config, RandomStream& random);

}  // namespace coop::sequencer
