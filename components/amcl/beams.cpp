#include "amcl/beams.hpp"

#include <algorithm>
#include <cmath>

namespace coop::amcl {

void select_beams(const LaserScan& scan, const Pose2& laser_in_base, int max_beams,
                  double max_range, std::size_t phase, BeamEnds& ends) {
  ends.x.clear();
  ends.y.clear();
  const auto usable = [&](std::size_t beam) {
    return scan.is_hit(beam) && static_cast<double>(scan.ranges[beam]) <= max_range;
  };
  std::size_t hits = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) hits += usable(i) ? 1 : 0;
  if (hits == 0 || max_beams < 1) return;

  const std::size_t wanted = std::min(hits, static_cast<std::size_t>(max_beams));
  const std::size_t longest_gap = (hits + wanted - 1) / wanted;
  // Hit number k is taken where (k * wanted + shift) / hits steps up: exactly `wanted` of `hits`,
  // evenly spaced.
  const std::size_t shift = (phase % longest_gap) * wanted;
  std::size_t k = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!usable(i)) continue;
    const std::size_t before = (k * wanted + shift) / hits;
    const std::size_t after = ((k + 1) * wanted + shift) / hits;
    ++k;
    if (after == before) continue;
    const double range = static_cast<double>(scan.ranges[i]);
    const double angle = static_cast<double>(scan.angle(i));
    const Eigen::Vector2d end =
        laser_in_base * Eigen::Vector2d{range * std::cos(angle), range * std::sin(angle)};
    ends.x.push_back(static_cast<float>(end.x()));
    ends.y.push_back(static_cast<float>(end.y()));
  }
}

}  // namespace coop::amcl
