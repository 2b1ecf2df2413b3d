#pragma once
#include <cstddef>
#include <vector>

#include "core/pose.hpp"
#include "core/scan.hpp"

namespace coop::amcl {

/// Ends of the chosen beams in base_link, m.
struct BeamEnds {
  std::vector<float> x;
  std::vector<float> y;

  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// At most `max_beams` beams of the scan, evenly spaced among those that hit something nearer than
/// `max_range` (m, on top of the scan's own limits). A beam that met nothing, or NaN, tells the
/// likelihood field nothing and is left out. `phase` shifts the choice, so that successive scans
/// use different beams. `ends` is overwritten and keeps its storage.
void select_beams(const LaserScan& scan, const Pose2& laser_in_base, int max_beams,
                  double max_range, std::size_t phase, BeamEnds& ends);

}  // namespace coop::amcl
