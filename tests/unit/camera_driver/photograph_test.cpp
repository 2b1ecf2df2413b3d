#include "camera_driver/photograph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/config/error.hpp"
#include "core/random.hpp"

namespace coop::camera_driver {
namespace {

/// Rough litter, 1000 x 500.
cv::Mat litter() {
  cv::Mat picture(500, 1000, CV_8UC3, cv::Scalar(150, 150, 160));
  RandomStream random(1, "litter");
  for (int i = 0; i < 12000; ++i) {
    const cv::Point from(static_cast<int>(random.below(1000)), static_cast<int>(random.below(500)));
    const cv::Point to = from + cv::Point(static_cast<int>(random.below(31)) - 15,
                                          static_cast<int>(random.below(31)) - 15);
    const double grey = random.uniform(60.0, 230.0);
    cv::line(picture, from, to, cv::Scalar(grey, grey, grey + 10.0), 3);
  }
  return picture;
}

void lay_egg(cv::Mat& picture, const cv::Point& center, double degrees,
             const cv::Scalar& colour = {200, 150, 120}) {
  cv::ellipse(picture, center, {31, 24}, degrees, 0, 360, colour, cv::FILLED, cv::LINE_AA);
}

TEST(Photograph, litter_has_no_eggs) {
  EXPECT_TRUE(find_eggs({}, litter()).empty());
}

TEST(Photograph, eggs_are_found_where_they_lie_and_of_their_size) {
  cv::Mat picture = litter();
  lay_egg(picture, {300, 200}, 30.0);
  lay_egg(picture, {700, 350}, 120.0);
  auto eggs = find_eggs({}, picture);
  ASSERT_EQ(eggs.size(), 2U);
  std::ranges::sort(eggs, {}, [](const PhotographedEgg& egg) { return egg.ellipse.column; });
  EXPECT_NEAR(eggs[0].ellipse.column, 300, 2.0);
  EXPECT_NEAR(eggs[0].ellipse.row, 200, 2.0);
  EXPECT_NEAR(eggs[0].ellipse.half_long, 31, 5.0);
  EXPECT_NEAR(eggs[0].ellipse.half_short, 24, 5.0);
  EXPECT_NEAR(eggs[1].ellipse.column, 700, 2.0);
  EXPECT_NEAR(eggs[1].ellipse.row, 350, 2.0);
}

TEST(Photograph, what_is_too_large_too_small_or_too_long_is_no_egg) {
  cv::Mat picture = litter();
  const cv::Scalar colour(200, 150, 120);
  cv::circle(picture, {150, 150}, 80, colour, cv::FILLED);
  cv::circle(picture, {400, 150}, 9, colour, cv::FILLED);
  cv::ellipse(picture, {700, 300}, {90, 24}, 20.0, 0, 360, colour, cv::FILLED);
  EXPECT_TRUE(find_eggs({}, picture).empty());
}

TEST(Photograph, the_depth_of_a_detection_is_where_an_egg_has_that_size) {
  PhotographedEgg egg;
  egg.ellipse.column = 100.0;
  egg.ellipse.row = 50.0;
  egg.ellipse.half_short = 22.5;
  egg.ellipse.half_long = 31.0;
  egg.score = 0.8;
  // 22.5 mm seen as 22.5 px by a focal length of 1000 px are 1 m away.
  const Intrinsics camera{200, 100, 1000.0, 1000.0, 100.0, 50.0};
  const Detection detection = to_detection(egg, camera);
  EXPECT_TRUE(detection.position.isApprox(Eigen::Vector3d(0.0, 0.0, 1.0)));
  EXPECT_NEAR(std::sqrt(detection.covariance(2, 2)), 0.15, 1e-9);
  EXPECT_NEAR(std::sqrt(detection.covariance(0, 0)), 0.002, 1e-9);
  EXPECT_NEAR(detection.size.x(), 0.062, 1e-9);
  EXPECT_NEAR(detection.size.y(), 0.045, 1e-9);
}

TEST(Photograph, refuses_a_least_width_beyond_the_greatest) {
  PhotographConfig config;
  config.min_width = 0.5;
  EXPECT_THROW(config.validate(), config::Error);
}

}  // namespace
}  // namespace coop::camera_driver
