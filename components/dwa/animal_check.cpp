#include "dwa/animal_check.hpp"

#include <algorithm>

namespace coop::dwa {
namespace {

constexpr double kRounding = 1e-3;  ///< m: no nearer than before, up to this

}  // namespace

AnimalCheck::AnimalCheck(const AnimalCheckConfig& config, const Footprint& footprint, double step)
    : config_(config), footprint_(footprint), step_(step), tracks_(config) {}

/// From the footprint to a disc: at the footprint's corners a little too small.
double AnimalCheck::gap(const Pose2& base, const Eigen::Vector2d& center, double radius) const {
  return -footprint_.depth(base.inverse() * center) - radius;
}

void AnimalCheck::place(const Pose2& base_in_odom, const Pose2& odom_in_map, Time now) {
  walkers_.clear();
  const Pose2 map_in_odom = odom_in_map.inverse();
  for (const AnimalTracks::Animal& animal : tracks_.animals()) {
    if (!tracks_.is_known(animal, now)) continue;
    const auto disc = tracks_.predicted(animal, to_seconds(now - animal.stamp));
    Walker walker;
    walker.center = map_in_odom * disc.center;
    walker.velocity =
        map_in_odom * Eigen::Vector2d(disc.center + animal.velocity_in_map) - walker.center;
    walker.radius = disc.radius;
    walker.gap = gap(base_in_odom, walker.center, walker.radius);
    walkers_.push_back(walker);
  }
}

bool AnimalCheck::hits(const Walker& walker, const Pose2& base, double seconds) const {
  if (walker.gap < 0.0) return gap(base, walker.center, walker.radius) < walker.gap - kRounding;
  return gap(base, walker.center + seconds * walker.velocity,
             walker.radius + config_.spread * seconds) < 0.0;
}

bool AnimalCheck::collides(const Trajectory& trajectory) const {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double seconds = step_ * static_cast<double>(i + 1);
    if (seconds > config_.horizon) return false;
    const auto hit = [&](const Walker& walker) { return hits(walker, trajectory[i], seconds); };
    if (std::ranges::any_of(walkers_, hit)) return true;
  }
  return false;
}

}  // namespace coop::dwa
