#pragma once
#include <array>
#include <memory>
#include <string_view>

#include "core/random.hpp"
#include "core/search/grid_planner.hpp"
#include "global_planner/swarm/swarm_planners.hpp"

namespace coop::global_planner {

/// Plans manoeuvres of the base (drivable_search); all others search the grid.
inline constexpr std::string_view kHybridAStar = "hybrid_astar";
inline constexpr std::string_view kJumpPoint = "jump_point";

/// As the configuration names them.
inline constexpr std::array<std::string_view, 11> kPlanners{
    kHybridAStar, "dijkstra", "astar", "theta_star", kJumpPoint, "casma",
    "aco",        "fa",       "pso",   "wpa",        "tabu"};

/// The search of that name, null for `hybrid_astar`. `random` feeds the swarms.
[[nodiscard]] std::unique_ptr<GridPlanner> make_grid_planner(std::string_view name,
                                                             const swarm::SwarmConfig& swarms,
                                                             const RandomStream& random);

}  // namespace coop::global_planner
