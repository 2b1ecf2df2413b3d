#include "camera_driver/intrinsics.hpp"

namespace coop::camera_driver {

Intrinsics d435i_intrinsics(int width, int height) {
  // At 640x480: focal lengths, and where the optical axis meets the picture.
  constexpr double kRows = 480.0;
  constexpr double kFx = 612.405334472656;
  constexpr double kFy = 610.648681640625;
  constexpr double kAxisRightOfMiddle = 314.25146484375 - 320.0;
  constexpr double kCy = 237.777557373047;
  const double scale = height / kRows;
  return {width,      height, kFx * scale, kFy * scale, 0.5 * width + kAxisRightOfMiddle * scale,
          kCy * scale};
}

}  // namespace coop::camera_driver
