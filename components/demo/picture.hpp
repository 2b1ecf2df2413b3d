#pragma once
#include <opencv2/core.hpp>

#include "demo/record.hpp"

namespace coop::demo {

/// Pixels a metre of the pictures.
inline constexpr double kPixelsPerMetre = 80.0;

/// The costmap in the colours of the egg paper's figure 3 (obstacles purple, inscribed light blue,
/// restricted blue, free grey-white, unknown grey), over it the true track (green), the estimated
/// one (orange), start, eggs with their place in the order.
[[nodiscard]] cv::Mat draw_run(const Record& record);

/// The map as map_server shows it, with the track.
[[nodiscard]] cv::Mat draw_map(const OccupancyGrid& map, const std::vector<TrackPoint>& track);

}  // namespace coop::demo
