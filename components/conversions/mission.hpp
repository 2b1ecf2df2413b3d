#pragma once
#include <coop_msgs/msg/Mission.h>
#include <coop_msgs/msg/MissionStatus.h>

#include <vector>

#include "core/costmap/spot.hpp"

namespace coop::conversions {

/// What must not come under the wheels: the eggs that are not picked, those that failed or were
/// missed included (none in a mission of kind CLEAN), each with `radius` (m) around it. Places that
/// are not finite are left out.
[[nodiscard]] std::vector<Spot> uncollected_eggs(const coop_msgs::msg::MissionStatus& message,
                                                 double radius);

}  // namespace coop::conversions
