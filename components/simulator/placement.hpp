#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/world/state.hpp"
#include "simulator/world_description.hpp"

namespace coop::simulator {

/// What lies on the floor for the robot to get at.
struct Quarry {
  std::string name;                     ///< for messages and for the stream of numbers
  Eigen::Vector2d place_in_base{0, 0};  ///< where it lies when the robot stands right for it, m
};

/// Random places that the robot can get at: each has a heading at which the robot stands with it
/// in the right place, and a straight way up to there, without touching anything, and connected to
/// its start by floor that is wide enough. `taken`: where something lies already. Throws
/// config::Error where there is no room for all of them.
[[nodiscard]] std::vector<Eigen::Vector2d> place_at_random(
    const RandomPlaces& wanted, const Quarry& quarry, const world::World& world,
    const RobotShape& robot, const std::vector<Eigen::Vector2d>& taken);

/// The animals of a world, those at random places included: on free floor, apart from each other
/// and from the robot. Throws config::Error where there is no room.
[[nodiscard]] std::vector<AnimalDescription> place_animals(const WorldDescription& description,
                                                           const world::World& world,
                                                           const RobotShape& robot);

}  // namespace coop::simulator
