#include "camera_driver/blob.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace coop::camera_driver {
namespace {

/// 40 x 30 pixels with rectangles of ones.
cv::Mat rectangles(const std::vector<cv::Rect>& filled) {
  cv::Mat mask(30, 40, CV_8UC1, cv::Scalar(0));
  for (const cv::Rect& one : filled) mask(one).setTo(255);
  return mask;
}

TEST(FindBlobs, a_rectangle_has_its_middle_and_the_axes_of_the_ellipse_of_its_moments) {
  cv::Mat labels;
  const auto blobs = find_blobs(rectangles({{10, 5, 12, 4}}), 1, 1000, labels);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].area, 48);
  EXPECT_DOUBLE_EQ(blobs[0].column, 15.5);
  EXPECT_DOUBLE_EQ(blobs[0].row, 6.5);
  // Variance of a stretch of length L is L^2/12, half axis twice its root: L/sqrt(3).
  EXPECT_NEAR(blobs[0].half_long, 12.0 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(blobs[0].half_short, 4.0 / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(blobs[0].angle, 0.0, 1e-9);
  EXPECT_NEAR(blobs[0].fill(), 3.0 / 3.14159265, 1e-6);
  EXPECT_FALSE(blobs[0].at_border);
}

TEST(FindBlobs, a_drawn_ellipse_is_measured) {
  cv::Mat mask(120, 160, CV_8UC1, cv::Scalar(0));
  cv::ellipse(mask, {80, 60}, {30, 18}, 25.0, 0.0, 360.0, cv::Scalar(255), cv::FILLED);
  cv::Mat labels;
  const auto blobs = find_blobs(mask, 1, 10000, labels);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_NEAR(blobs[0].column, 80.0, 0.1);
  EXPECT_NEAR(blobs[0].row, 60.0, 0.1);
  EXPECT_NEAR(blobs[0].half_long, 30.5, 0.5);
  EXPECT_NEAR(blobs[0].half_short, 18.5, 0.5);
  EXPECT_NEAR(blobs[0].angle, 25.0 * 3.14159265 / 180.0, 0.02);
  EXPECT_NEAR(blobs[0].fill(), 1.0, 0.02);
}

TEST(FindBlobs, corners_join_and_gaps_part) {
  cv::Mat labels;
  EXPECT_EQ(find_blobs(rectangles({{5, 5, 3, 3}, {8, 8, 3, 3}}), 1, 1000, labels).size(), 1U);
  EXPECT_EQ(find_blobs(rectangles({{5, 5, 3, 3}, {9, 9, 3, 3}}), 1, 1000, labels).size(), 2U);
}

TEST(FindBlobs, too_small_and_too_large_ones_are_left_out) {
  cv::Mat labels;
  const cv::Mat mask = rectangles({{1, 1, 2, 2}, {10, 10, 4, 4}, {20, 10, 10, 10}});
  const auto blobs = find_blobs(mask, 5, 50, labels);
  ASSERT_EQ(blobs.size(), 1U);
  EXPECT_EQ(blobs[0].area, 16);
  EXPECT_EQ(labels.at<int>(11, 11), blobs[0].label);
}

TEST(FindBlobs, one_that_reaches_the_border_is_marked) {
  cv::Mat labels;
  for (const cv::Rect& edge :
       {cv::Rect(0, 9, 4, 4), cv::Rect(9, 0, 4, 4), cv::Rect(36, 9, 4, 4), cv::Rect(9, 26, 4, 4)}) {
    const auto blobs = find_blobs(rectangles({edge}), 1, 1000, labels);
    ASSERT_EQ(blobs.size(), 1U);
    EXPECT_TRUE(blobs[0].at_border);
  }
}

TEST(SplitBlob, two_squares_joined_by_a_bridge_are_parted_in_the_middle_of_it) {
  cv::Mat labels;
  const cv::Mat mask = rectangles({{4, 4, 9, 9}, {13, 8, 2, 1}, {15, 4, 9, 9}});
  const auto blobs = find_blobs(mask, 1, 1000, labels);
  ASSERT_EQ(blobs.size(), 1U);
  const auto parts = split_blob(blobs[0], 2.5, labels, 7);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].area, 82);
  EXPECT_EQ(parts[1].area, 82);
  EXPECT_NEAR(parts[0].column, 8.0, 0.1);
  EXPECT_NEAR(parts[1].column, 19.0, 0.1);
  EXPECT_EQ(labels.at<int>(8, 8), 7);
  EXPECT_EQ(labels.at<int>(8, 19), 8);
}

TEST(SplitBlob, one_square_has_one_core_and_a_thin_line_none) {
  cv::Mat labels;
  const auto square = find_blobs(rectangles({{4, 4, 9, 9}}), 1, 1000, labels);
  EXPECT_TRUE(split_blob(square[0], 2.5, labels, 7).empty());
  const auto line = find_blobs(rectangles({{4, 4, 20, 2}}), 1, 1000, labels);
  EXPECT_TRUE(split_blob(line[0], 2.5, labels, 7).empty());
  EXPECT_EQ(labels.at<int>(4, 5), line[0].label);
}

}  // namespace
}  // namespace coop::camera_driver
