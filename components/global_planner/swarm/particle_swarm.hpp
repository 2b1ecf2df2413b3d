#pragma once
#include "global_planner/swarm/optimiser.hpp"

namespace coop::global_planner::swarm {

struct ParticleSwarmConfig {
  PopulationConfig swarm;
  double first_inertia = 0.9;  ///< the text below equation 10; table 8 says 5, which diverges
  double last_inertia = 0.4;
  double cognitive_rate = 1.5;  ///< c1, towards the particle's own best place
  double social_rate = 1.6;     ///< c2, towards the swarm's
  /// false: equation 10 as printed, where the second pull also goes to the particle's own best.
  bool sees_swarm = true;

  void describe(config::Fields& fields);
};

/// PSO (the paper's equation 10). Velocities begin at zero and are not limited.
class ParticleSwarm final : public Optimiser {
 public:
  explicit ParticleSwarm(const ParticleSwarmConfig& config) : config_(config) {}
  Minimum minimise(Objective& objective, RandomStream& random,
                   std::vector<double>* course) override;

 private:
  ParticleSwarmConfig config_;
};

}  // namespace coop::global_planner::swarm
