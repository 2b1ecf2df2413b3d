#pragma once
#include <vector>

#include "sequencer/path_costs.hpp"

namespace coop::experiments {

/// Path costs over the costmap of maps/duck_house, inflated as the global planner's.
[[nodiscard]] sequencer::PathCosts duck_house_costs();

/// Where the robot stands at first; as the eggs' region that of maps/duck_house.world.yaml.
inline constexpr Pose2 kDuckHouseStart{1.6, 2.1, 0.0};

/// Places within the house that can be reached from the start.
[[nodiscard]] std::vector<Eigen::Vector2d> duck_house_eggs(sequencer::PathCosts& costs,
                                                           std::size_t count, std::uint64_t seed);

}  // namespace coop::experiments
