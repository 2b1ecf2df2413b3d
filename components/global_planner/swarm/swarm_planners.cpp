#include "global_planner/swarm/swarm_planners.hpp"

namespace coop::global_planner::swarm {

void SwarmConfig::describe(config::Fields& fields) {
  fields.integer("seed", seed, {.help = "of all draws", .min = 0});
  fields.section("casma", casma);
  fields.section("aco", aco);
  fields.section("fa", fa);
  fields.section("pso", pso);
  fields.section("wpa", wpa);
  fields.section("tabu", tabu);
  fields.section("paths", paths);
}

std::unique_ptr<GridPlanner> make_swarm_planner(std::string_view name, const SwarmConfig& config) {
  const auto stream = [&](std::string_view stream_name) {
    return RandomStream(static_cast<std::uint64_t>(config.seed), stream_name);
  };
  const auto over_via_points = [&](std::unique_ptr<Optimiser> optimiser,
                                   std::string_view stream_name) {
    return std::make_unique<ViaPointPlanner>(config.paths, std::move(optimiser),
                                             stream(stream_name));
  };
  if (name == "casma") return std::make_unique<Casma>(config.casma, stream("casma"));
  if (name == "aco") return std::make_unique<AntColony>(config.aco, stream("aco"));
  if (name == "fa") return over_via_points(std::make_unique<Fireflies>(config.fa), "FA");
  if (name == "pso") return over_via_points(std::make_unique<ParticleSwarm>(config.pso), "PSO");
  if (name == "wpa") return over_via_points(std::make_unique<WolfPack>(config.wpa), "WPA");
  if (name == "tabu") return std::make_unique<Tabu>(config.tabu, stream("tabu"));
  return nullptr;
}

}  // namespace coop::global_planner::swarm
