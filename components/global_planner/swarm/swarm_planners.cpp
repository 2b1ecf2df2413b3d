#include "global_planner/swarm/swarm_planners.hpp"

namespace coop::global_planner::swarm {

void SwarmConfig::describe(config::Fields& fields) {
  fields.section("casma", casma);
  fields.section("aco", aco);
  fields.section("fa", fa);
  fields.section("pso", pso);
  fields.section("wpa", wpa);
  fields.section("tabu", tabu);
  fields.section("paths", paths);
}

std::unique_ptr<GridPlanner> make_swarm_planner(std::string_view name, const SwarmConfig& config,
                                                const RandomStream& random) {
  const auto over_via_points = [&](std::unique_ptr<Optimiser> optimiser) {
    return std::make_unique<ViaPointPlanner>(config.paths, std::move(optimiser), random);
  };
  if (name == "casma") return std::make_unique<Casma>(config.casma, random);
  if (name == "aco") return std::make_unique<AntColony>(config.aco, random);
  if (name == "fa") return over_via_points(std::make_unique<Fireflies>(config.fa));
  if (name == "pso") return over_via_points(std::make_unique<ParticleSwarm>(config.pso));
  if (name == "wpa") return over_via_points(std::make_unique<WolfPack>(config.wpa));
  if (name == "tabu") return std::make_unique<Tabu>(config.tabu, random);
  return nullptr;
}

}  // namespace coop::global_planner::swarm
