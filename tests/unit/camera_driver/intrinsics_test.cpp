#include "camera_driver/intrinsics.hpp"

#include <gtest/gtest.h>

namespace coop::camera_driver {
namespace {

TEST(Intrinsics, an_egg_a_metre_ahead_and_a_decimetre_right_is_ten_pixels_off_the_axis) {
  const Intrinsics camera{200, 100, 100.0, 100.0, 99.5, 49.5};
  EXPECT_TRUE(camera.project({0.1, 0.0, 1.0}).isApprox(Eigen::Vector2d(109.5, 49.5)));
  EXPECT_TRUE(camera.project({0.1, -0.2, 2.0}).isApprox(Eigen::Vector2d(104.5, 39.5)));
}

TEST(Intrinsics, a_pixel_and_its_depth_give_back_the_point_that_was_projected) {
  const Intrinsics camera = d435i_intrinsics(424, 240);
  const Eigen::Vector3d point(-0.31, 0.22, 1.7);
  const Eigen::Vector2d pixel = camera.project(point);
  EXPECT_TRUE((point.z() * camera.ray(pixel.x(), pixel.y())).isApprox(point, 1e-12));
}

TEST(Intrinsics, of_a_d435i_are_the_published_ones_at_each_resolution) {
  struct Published {
    int width, height;
    double fx, fy, cx, cy;
  };
  // librealsense issue 4050
  for (const Published& p : {Published{320, 240, 306.2027, 305.3243, 157.1257, 118.8888},
                             Published{424, 240, 306.2027, 305.3243, 209.1257, 118.8888},
                             Published{640, 360, 459.3040, 457.9865, 315.6886, 178.3332},
                             Published{640, 480, 612.4053, 610.6487, 314.2515, 237.7776}}) {
    const Intrinsics camera = d435i_intrinsics(p.width, p.height);
    EXPECT_NEAR(camera.fx, p.fx, 1e-3);
    EXPECT_NEAR(camera.fy, p.fy, 1e-3);
    EXPECT_NEAR(camera.cx, p.cx, 1e-3);
    EXPECT_NEAR(camera.cy, p.cy, 1e-3);
  }
}

}  // namespace
}  // namespace coop::camera_driver
