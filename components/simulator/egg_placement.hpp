#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/world/state.hpp"
#include "simulator/world_description.hpp"

namespace coop::simulator {

/// Random places for eggs that the robot can pick up: each has a heading at which the robot stands
/// with the egg in its working point, and a straight way up to there, without touching anything,
/// and connected to its start by floor that is wide enough. `taken`: eggs that lie already. Throws
/// config::Error where there is no room for all of them.
[[nodiscard]] std::vector<Eigen::Vector2d> place_eggs(const RandomEggs& wanted,
                                                      const world::World& world,
                                                      const RobotShape& robot,
                                                      const std::vector<Eigen::Vector2d>& taken);

}  // namespace coop::simulator
