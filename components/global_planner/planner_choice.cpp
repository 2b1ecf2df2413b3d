#include "global_planner/planner_choice.hpp"

#include "core/search/a_star.hpp"
#include "core/search/dijkstra.hpp"
#include "core/search/jump_point.hpp"
#include "core/search/theta_star.hpp"

namespace coop::global_planner {

std::unique_ptr<GridPlanner> make_grid_planner(std::string_view name,
                                               const swarm::SwarmConfig& swarms,
                                               const RandomStream& random) {
  if (name == "dijkstra") return std::make_unique<Dijkstra>();
  if (name == "astar") return std::make_unique<AStar>();
  if (name == "theta_star") return std::make_unique<ThetaStar>();
  if (name == kJumpPoint) return std::make_unique<JumpPoint>();
  return swarm::make_swarm_planner(name, swarms, random);
}

}  // namespace coop::global_planner
