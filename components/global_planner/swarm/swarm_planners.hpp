#pragma once
#include <array>
#include <memory>
#include <string_view>

#include "core/random.hpp"
#include "global_planner/swarm/ant_colony.hpp"
#include "global_planner/swarm/casma.hpp"
#include "global_planner/swarm/fireflies.hpp"
#include "global_planner/swarm/particle_swarm.hpp"
#include "global_planner/swarm/tabu.hpp"
#include "global_planner/swarm/via_points.hpp"
#include "global_planner/swarm/wolf_pack.hpp"

namespace coop::global_planner::swarm {

/// The CASMA paper's planners by their names in a configuration.
inline constexpr std::array<std::string_view, 6> kSwarmPlanners{"casma", "aco", "fa",
                                                                "pso",   "wpa", "tabu"};

struct SwarmConfig {
  CasmaConfig casma;
  AntColonyConfig aco;
  FirefliesConfig fa;
  ParticleSwarmConfig pso;
  WolfPackConfig wpa;
  TabuConfig tabu;
  ViaPointConfig paths;  ///< what fireflies, particles and wolves move

  void describe(config::Fields& fields);
};

/// One of kSwarmPlanners; nothing for another name. `random`: of all its draws.
[[nodiscard]] std::unique_ptr<GridPlanner> make_swarm_planner(std::string_view name,
                                                              const SwarmConfig& config,
                                                              const RandomStream& random);

}  // namespace coop::global_planner::swarm
