#pragma once
#include "core/intrinsics.hpp"

namespace coop::camera_driver {

/// Calibration of a D435i's colour camera at a resolution. One unit's published values for 320x240,
/// 424x240, 640x360 and 640x480 (librealsense issue 4050) are those of one picture of the full
/// height, scaled to the rows and cropped in width around its middle: so for any resolution.
[[nodiscard]] Intrinsics d435i_intrinsics(int width, int height);

}  // namespace coop::camera_driver
