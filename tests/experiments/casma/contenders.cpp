#include "experiments/casma/contenders.hpp"

#include <utility>

#include "experiments/casma/coin_walk.hpp"
#include "experiments/casma/turned.hpp"
#include "global_planner/swarm/ant_sampler.hpp"
#include "global_planner/swarm/slime_optimiser.hpp"
#include "global_planner/swarm/step_search.hpp"
#include "global_planner/swarm/swarm_planners.hpp"

namespace coop::casma {
namespace {

using namespace global_planner::swarm;

/// One of the family as it stands in a configuration. `stream`: name of its random stream.
Contender swarm_planner(std::string name, std::string paper_name, const std::string& key,
                        const std::string& stream, const SwarmConfig& config = {}) {
  return {std::move(name), std::move(paper_name), [key, stream, config](std::uint64_t seed) {
            return make_swarm_planner(key, config, RandomStream(seed, stream));
          }};
}

Contender casma_by(const std::string& method) {
  SwarmConfig config;
  config.casma.method = method;
  return swarm_planner("CASMA " + method, "CASMA", "casma", "casma", config);
}

Contender casma_over_via_points() {
  const std::string name = "CASMA via points";
  return {name, "CASMA", [name](std::uint64_t seed) {
            return std::make_unique<ViaPointPlanner>(
                ViaPointConfig{}, std::make_unique<SlimeOptimiser>(SlimeOptimiserConfig{}),
                RandomStream(seed, name));
          }};
}

Contender exact(const std::string& name, StepSearch::Guidance guidance) {
  return {name, name == "A*" ? "A*" : "",
          [guidance](std::uint64_t) { return std::make_unique<StepSearch>(guidance); }};
}

template <class Swarm, class Config>
Searcher searcher(std::string name, std::string paper_name, Config config) {
  return {std::move(name), std::move(paper_name),
          [config] { return std::make_unique<Swarm>(config); }};
}

}  // namespace

std::vector<Contender> contenders() {
  return {
      casma_by("best"),
      casma_by("paper"),
      {"CASMA paper, turned", "",
       [](std::uint64_t seed) { return std::make_unique<Turned>(casma_by("paper").make(seed)); }},
      casma_by("printed"),
      casma_over_via_points(),
      swarm_planner("ACO", "ACO", "aco", "aco"),
      swarm_planner("FA", "FA", "fa", "FA"),
      swarm_planner("PSO", "PSO", "pso", "PSO"),
      swarm_planner("WPA", "WPA", "wpa", "WPA"),
      swarm_planner("TS", "TS", "tabu", "tabu"),
      exact("A*", StepSearch::Guidance::kManhattan),
      exact("Dijkstra", StepSearch::Guidance::kNone),
      {"coin", "", [](std::uint64_t seed) {
         return std::make_unique<CoinWalk>(100, RandomStream(seed, "coin"));
       }}};
}

std::vector<Contender> moving_contenders() {
  return {casma_by("best"), casma_by("paper"), exact("A*", StepSearch::Guidance::kManhattan),
          swarm_planner("TS", "TS", "tabu", "tabu"),
          exact("Dijkstra", StepSearch::Guidance::kNone)};
}

std::vector<Searcher> searchers() {
  ParticleSwarmConfig table_eight;
  table_eight.first_inertia = table_eight.last_inertia = 5.0;
  ParticleSwarmConfig own_best_only;
  own_best_only.sees_swarm = false;
  FirefliesConfig repelled;
  repelled.as_printed = true;
  FirefliesConfig uncooled;
  uncooled.cooling = 1.0;
  SlimeOptimiserConfig printed;
  printed.as_printed = true;
  return {searcher<AntSampler>("ACO", "ACO", AntSamplerConfig{}),
          searcher<Fireflies>("FA", "FA", FirefliesConfig{}),
          searcher<ParticleSwarm>("PSO", "PSO", ParticleSwarmConfig{}),
          searcher<SlimeOptimiser>("CASMA", "CASMA", SlimeOptimiserConfig{}),
          searcher<WolfPack>("WPA", "WPA", WolfPackConfig{}),
          searcher<Fireflies>("FA repelled (eq. 11 as printed)", "FA", repelled),
          searcher<Fireflies>("FA not cooled", "FA", uncooled),
          searcher<ParticleSwarm>("PSO inertia 5 (table 8)", "PSO", table_eight),
          searcher<ParticleSwarm>("PSO without swarm (eq. 10 as printed)", "PSO", own_best_only),
          searcher<SlimeOptimiser>("CASMA printed (eq. 6, 7)", "CASMA", printed)};
}

}  // namespace coop::casma
