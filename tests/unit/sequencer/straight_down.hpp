#pragma once
#include <numbers>

#include "sequencer/camera_view.hpp"

namespace coop::sequencer::test {

/// A camera that looks straight down from where eggs' centres are 1 m away: 100 pixels show 1 m, so
/// the picture is the square of 1 m around `middle`.
inline CameraView straight_down(const Eigen::Vector2d& middle) {
  CameraView view;
  view.camera_in_map = Eigen::Translation3d(middle.x(), middle.y(), 1.022) *
                       Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
  view.intrinsics = {.width = 101, .height = 101, .fx = 100, .fy = 100, .cx = 50, .cy = 50};
  return view;
}

}  // namespace coop::sequencer::test
