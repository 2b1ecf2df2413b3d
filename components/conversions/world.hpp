#pragma once
#include <coop_msgs/msg/GroundTruth.h>
#include <coop_msgs/msg/World.h>

#include <string>

#include "core/result.hpp"
#include "core/time.hpp"
#include "core/world/state.hpp"

namespace coop::conversions {

/// Frame of all that the simulator tells of its world.
inline constexpr const char* kWorldFrame = "world";

[[nodiscard]] coop_msgs::msg::World to_msg(const world::World& world, Time stamp);
/// Refused: a grid that is none (navigation.hpp), states of eggs that do not exist, numbers that
/// are not finite.
[[nodiscard]] Result<world::World> from_msg(const coop_msgs::msg::World& message);

[[nodiscard]] coop_msgs::msg::GroundTruth to_msg(const world::GroundTruth& truth);
/// Refused: states of eggs that do not exist, numbers that are not finite, animals of negative
/// radius.
[[nodiscard]] Result<world::GroundTruth> from_msg(const coop_msgs::msg::GroundTruth& message);

}  // namespace coop::conversions
