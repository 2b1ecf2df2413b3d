#include "conversions/mission.hpp"

namespace coop::conversions {

std::vector<Spot> uncollected_eggs(const coop_msgs::msg::MissionStatus& message, double radius) {
  std::vector<Spot> spots;
  // Manure is there to be driven over.
  if (message.kind() == coop_msgs::msg::Mission_Constants::CLEAN) return spots;
  for (const auto& egg : message.eggs()) {
    if (egg.state() == coop_msgs::msg::EggStatus_Constants::PICKED) continue;
    const Eigen::Vector2d place(egg.position().x(), egg.position().y());
    if (place.allFinite()) spots.push_back({place, radius});
  }
  return spots;
}

}  // namespace coop::conversions
