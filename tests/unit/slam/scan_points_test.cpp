#include "slam/scan_points.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace coop::slam {
namespace {

constexpr float kQuarter = static_cast<float>(std::numbers::pi / 2);

/// Beams to the right, ahead and to the left.
LaserScan scan(std::vector<float> ranges) {
  LaserScan result;
  result.angle_min = -kQuarter;
  result.angle_increment = kQuarter;
  result.range_min = 0.1F;
  result.range_max = 10.0F;
  result.ranges = std::move(ranges);
  return result;
}

TEST(ScanPoints, EndsAreInTheFrameOfTheBase) {
  const auto points = to_points(scan({1, 2, 3}), {0.5, 0.1, 0.0}, {}, {});
  ASSERT_EQ(points.ends.size(), 3U);
  EXPECT_NEAR(points.ends[0].x(), 0.5, 1e-6);
  EXPECT_NEAR(points.ends[0].y(), -0.9, 1e-6);
  EXPECT_NEAR(points.ends[1].x(), 2.5, 1e-6);
  EXPECT_NEAR(points.ends[2].y(), 3.1, 1e-6);
  EXPECT_EQ(points.laser_in_base, Eigen::Vector2d(0.5, 0.1));
  EXPECT_EQ(points.match.size(), 3U);
}

TEST(ScanPoints, BeamsWithoutMeasurementAreLeftOut) {
  const float infinity = std::numeric_limits<float>::infinity();
  const auto points =
      to_points(scan({0.05F, infinity, std::numeric_limits<float>::quiet_NaN()}), {}, {}, {});
  EXPECT_TRUE(points.empty());
  EXPECT_TRUE(points.ends.empty());
  EXPECT_TRUE(points.open_ends.empty());
}

TEST(ScanPoints, BeamThatMetNothingFreesItsWayWhereAskedTo) {
  ScanPointsConfig config;
  config.clear_without_return = true;
  config.map_range = 4.0;
  const float infinity = std::numeric_limits<float>::infinity();
  const auto points = to_points(scan({1, infinity, 0.05F}), {}, {}, config);
  ASSERT_EQ(points.open_ends.size(), 1U) << "too near is no measurement and frees nothing";
  EXPECT_NEAR(points.open_ends[0].x(), 4.0, 1e-6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(to_points(scan({nan, -infinity, nan}), {}, {}, config).open_ends.empty());
}

TEST(ScanPoints, EndBeyondTheMapRangeFreesTheWayUpToIt) {
  ScanPointsConfig config;
  config.map_range = 2.5;
  config.match_range = 1.5;
  const auto points = to_points(scan({1, 2, 3}), {}, {}, config);
  EXPECT_EQ(points.ends.size(), 2U);
  ASSERT_EQ(points.open_ends.size(), 1U);
  EXPECT_NEAR(points.open_ends[0].y(), 2.5, 1e-6);
  EXPECT_EQ(points.match.size(), 1U);
}

TEST(ScanPoints, BeamsOfASweepStartWhereTheBaseWasAtTheirTime) {
  // The base drives 0.4 m and turns by 90 degrees while the laser sweeps three beams.
  const auto points = to_points(scan({1, 2, 3}), {}, {0.4, 0.0, std::numbers::pi / 2}, {});
  EXPECT_NEAR(points.ends[0].y(), -1.0, 1e-6);
  const double middle = std::numbers::pi / 4;
  EXPECT_NEAR(points.ends[1].x(), 0.2 + 2 * std::cos(middle), 1e-6);
  EXPECT_NEAR(points.ends[1].y(), 2 * std::sin(middle), 1e-6);
  EXPECT_NEAR(points.ends[2].x(), 0.4 - 3.0, 1e-6);
}

TEST(ScanPoints, MatchedEndsAreThinnedEvenlyAndSpaced) {
  LaserScan dense;
  dense.angle_increment = 0.001F;
  dense.range_max = 10.0F;
  dense.ranges.assign(1000, 2.0F);
  ScanPointsConfig config;
  config.max_match_points = 100;
  EXPECT_EQ(to_points(dense, {}, {}, config).match.size(), 100U);
  config.min_spacing = 0.05;  // neighbours are 2 mm apart
  EXPECT_NEAR(static_cast<double>(to_points(dense, {}, {}, config).match.size()), 40.0, 1.0);
}

}  // namespace
}  // namespace coop::slam
