#include "camera_driver/sensor_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace coop::camera_driver {
namespace {

constexpr int kColumns = 424;
constexpr int kRows = 240;

Frame grey_frame(Time stamp) {
  return {stamp, cv::Mat(kRows, kColumns, CV_8UC3, cv::Scalar::all(128)),
          cv::Mat(kRows, kColumns, CV_16UC1)};
}

/// Depths measured of a wall at `depth`, m, and what a frame says of the noise.
Frame measure(const SensorNoiseConfig& config, double depth, Time stamp = time_from_seconds(3.0),
              std::uint64_t seed = 5) {
  Frame frame = grey_frame(stamp);
  const std::vector<float> exact(kColumns * kRows, static_cast<float>(depth));
  SensorNoise(config, 0.2, 6.0, seed).apply(exact, frame);
  return frame;
}

struct Moments {
  double mean = 0.0;    ///< m
  double stddev = 0.0;  ///< m
  double missing = 0.0;
  double neighbours = 0.0;  ///< correlation of pixels next to each other in a row
};
Moments moments(const cv::Mat& depth) {
  double sum = 0.0;
  double squares = 0.0;
  double products = 0.0;
  int seen = 0;
  int pairs = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double z = 0.001 * depth.at<std::uint16_t>(row, column);
      if (z == 0.0) continue;
      ++seen;
      sum += z;
      squares += z * z;
    }
  }
  const double mean = sum / seen;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 1; column < kColumns; ++column) {
      const double a = 0.001 * depth.at<std::uint16_t>(row, column - 1);
      const double b = 0.001 * depth.at<std::uint16_t>(row, column);
      if (a == 0.0 || b == 0.0) continue;
      ++pairs;
      products += (a - mean) * (b - mean);
    }
  }
  const double variance = squares / seen - mean * mean;
  return {mean, std::sqrt(variance), 1.0 - static_cast<double>(seen) / (kRows * kColumns),
          products / pairs / variance};
}

TEST(SensorNoise, depth_spreads_as_the_model_says_at_one_and_at_two_metres) {
  SensorNoiseConfig config;
  config.smooth_share = 0.0;
  // 2 mm + 2.5 mm = 4.5 mm at 1 m, 2 mm + 10 mm at 2 m; of 100 000 pixels.
  const Moments near = moments(measure(config, 1.0).depth);
  EXPECT_NEAR(near.mean, 1.0, 1e-4);
  EXPECT_NEAR(near.stddev, 0.0045, 1e-4);
  const Moments far = moments(measure(config, 2.0).depth);
  EXPECT_NEAR(far.mean, 2.0, 2e-4);
  EXPECT_NEAR(far.stddev, 0.012, 2e-4);
}

TEST(SensorNoise, neighbours_share_the_part_of_the_variance_they_are_to_share) {
  SensorNoiseConfig config;
  config.smooth_share = 0.0;
  EXPECT_NEAR(moments(measure(config, 2.0).depth).neighbours, 0.0, 0.02);
  config.smooth_share = 0.5;
  const Moments half = moments(measure(config, 2.0).depth);
  // A bell of 2.5 px seen a pixel off still agrees by 96 %.
  EXPECT_NEAR(half.neighbours, 0.48, 0.04);
  EXPECT_NEAR(half.stddev, 0.012, 6e-4);
}

TEST(SensorNoise, loses_the_share_of_pixels_it_is_to_lose) {
  SensorNoiseConfig config;
  config.dropout = 0.05;
  EXPECT_NEAR(moments(measure(config, 1.0).depth).missing, 0.05, 0.005);
}

TEST(SensorNoise, what_is_nothing_too_near_or_too_far_has_no_depth) {
  for (const double depth : {0.0, 0.15, 6.5}) {
    EXPECT_EQ(cv::countNonZero(measure({}, depth).depth), 0) << depth;
  }
}

TEST(SensorNoise, colour_spreads_by_the_deviation_asked_for) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(measure({}, 1.0).colour, mean, deviation);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean[i], 128.0, 0.1);
    EXPECT_NEAR(deviation[i], 3.0, 0.1);  // 1/12 more in variance by rounding
  }
}

TEST(SensorNoise, is_the_same_for_the_same_seed_and_stamp_and_another_otherwise) {
  const auto differ = [](const Frame& a, const Frame& b) {
    return cv::countNonZero(a.depth != b.depth) > kRows * kColumns / 2;
  };
  const Frame frame = measure({}, 1.0);
  EXPECT_EQ(cv::countNonZero(frame.depth != measure({}, 1.0).depth), 0);
  EXPECT_TRUE(differ(frame, measure({}, 1.0, time_from_seconds(3.2))));
  EXPECT_TRUE(differ(frame, measure({}, 1.0, time_from_seconds(3.0), 6)));
}

}  // namespace
}  // namespace coop::camera_driver
