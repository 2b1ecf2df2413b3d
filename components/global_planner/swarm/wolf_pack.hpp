#pragma once
#include "global_planner/swarm/optimiser.hpp"

namespace coop::global_planner::swarm {

struct WolfPackConfig {
  PopulationConfig swarm;
  double contraction = 0.5;  ///< walpha of table 8: step of calling and of the siege at first
  double exploration =
      0.3;                ///< wbeta of table 8: share of scouts, and their step in sides of the box
  double renewal = 0.05;  ///< share of wolves, the worst, born anew an iteration

  void describe(config::Fields& fields);
};

/// WPA (Wu, Zhang, Wu 2013; the paper's equation 9): scouts look around, the others are called to
/// the leader and besiege the prey, the weakest are replaced. A wolf stays where a step would be
/// worse. Steps shrink to nothing with the iterations.
class WolfPack final : public Optimiser {
 public:
  explicit WolfPack(const WolfPackConfig& config) : config_(config) {}
  Minimum minimise(Objective& objective, RandomStream& random,
                   std::vector<double>* course) override;

 private:
  void scout(Population& wolves, std::size_t i, double step, RandomStream& random);
  void besiege(Population& wolves, std::size_t i, double step, RandomStream& random);
  void renew(Population& wolves, RandomStream& random);
  void go_if_better(Population& wolves, std::size_t i);

  WolfPackConfig config_;
  std::vector<double> trial_;
  std::vector<std::size_t> order_;
};

}  // namespace coop::global_planner::swarm
