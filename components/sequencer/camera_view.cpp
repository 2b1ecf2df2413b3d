#include "sequencer/camera_view.hpp"

namespace coop::sequencer {

namespace {
constexpr double kEggHeight = 0.022;  ///< m of its centre above the floor
constexpr double kDeviations = 2.0;   ///< of a place, that must be in the picture
}  // namespace

void CameraViewConfig::describe(config::Fields& fields) {
  fields.number("margin", margin,
                {.unit = "m", .help = "an egg so near to the border may be cut", .min = 0});
  fields.number("distance", distance,
                {.unit = "m", .help = "from the camera; farther eggs may be missed", .min = 0});
}

bool CameraView::shows(const Eigen::Vector2d& place_in_map, double stddev,
                       const CameraViewConfig& config) const {
  const Eigen::Vector3d egg_in_map(place_in_map.x(), place_in_map.y(), kEggHeight);
  const Eigen::Vector3d egg = camera_in_map.inverse() * egg_in_map;
  if (egg.z() <= 0.0 || egg.norm() > config.distance) return false;
  const Eigen::Vector2d pixel = intrinsics.project(egg);
  const double around = (config.margin + kDeviations * stddev) / egg.z();
  const double left_right = around * intrinsics.fx;
  const double up_down = around * intrinsics.fy;
  return pixel.x() >= left_right && pixel.x() <= intrinsics.width - 1 - left_right &&
         pixel.y() >= up_down && pixel.y() <= intrinsics.height - 1 - up_down;
}

}  // namespace coop::sequencer
