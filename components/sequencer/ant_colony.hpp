#pragma once
#include "core/config/fields.hpp"
#include "core/random.hpp"
#include "sequencer/cost_matrix.hpp"

namespace coop::sequencer {

struct AntColonyConfig {
  int ants = 30;         ///< m
  double alpha = 1.0;    ///< importance of pheromone
  double beta = 2.0;     ///< importance of the heuristic, 1 / distance
  double rho = 0.1;      ///< evaporation an iteration
  double q = 0.1;        ///< pheromone constant, m
  int iterations = 200;  ///< t_max
  double initial = 1.0;  ///< pheromone of every edge at the start
  bool closed = false;   ///< the tour ends where it began

  void describe(config::Fields& fields);
};

/// The order of collecting by the ant colony of "Research on Path Planning Optimization Technology
/// of Egg Collecting Robot Based on ROS" (2024), section 2.3.1: each ant picks its next node by
/// roulette over tau^alpha eta^beta among the nodes not in its taboo table (equation 1); after each
/// iteration tau evaporates and every ant leaves Q / L_k on its edges (equations 2 and 3, ant cycle
/// model). The best tour of all iterations is the result.
///
/// Deviation: for an open tour every ant starts where the robot stands (node 0), not at a random
/// node; on a closed tour the start does not matter for its length and is drawn at random, as in
/// the paper, and the result is turned to begin at node 0.
[[nodiscard]] Tour solve_by_ant_colony(const CostMatrix& costs, const AntColonyConfig& config,
                                       RandomStream& random);

}  // namespace coop::sequencer
