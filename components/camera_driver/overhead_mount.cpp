#include "camera_driver/overhead_mount.hpp"

#include <cmath>

namespace coop::camera_driver {

void OverheadMount::describe(config::Fields& fields) {
  fields.number("x", x, {.unit = "m", .help = "of the camera in map"});
  fields.number("y", y, {.unit = "m", .help = "of the camera in map"});
  fields.number("height", height,
                {.unit = "m", .help = "of the camera above the floor", .min = 1, .max = 20});
  fields.number("yaw", yaw,
                {.unit = "rad", .help = "of the picture's columns in map", .min = -7, .max = 7});
  fields.integer("width", width, {.unit = "px", .help = "columns", .min = 64, .max = 4096});
  fields.integer("rows", rows, {.unit = "px", .help = "rows", .min = 48, .max = 4096});
  fields.number("field_of_view", field_of_view,
                {.unit = "rad", .help = "across the width", .min = 0.2, .max = 2.6});
}

Intrinsics OverheadMount::intrinsics() const {
  const double focal = 0.5 * width / std::tan(0.5 * field_of_view);
  return {width, rows, focal, focal, 0.5 * (width - 1), 0.5 * (rows - 1)};
}

Pose3 OverheadMount::camera_in_map() const {
  Pose3 pose = Pose3::Identity();
  pose.translation() << x, y, height;
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  pose.linear() << c, s, 0.0,  //
      s, -c, 0.0,              //
      0.0, 0.0, -1.0;
  return pose;
}

}  // namespace coop::camera_driver
