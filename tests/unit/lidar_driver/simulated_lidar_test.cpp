#include "lidar_driver/simulated_lidar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/room.hpp"

namespace coop::lidar_driver {
namespace {

constexpr double kPi = std::numbers::pi;

/// Four beams: back, right, ahead, left; no noise.
constexpr SimulatedLidarConfig kCross{
    .beams = 4, .range_min = 0.1, .range_max = 5.0, .range_noise = 0.0, .dropout = 0.0};

/// From (0, 0) to (8, 3).
world::World room() {
  return test::room(80, 30);
}

world::GroundTruth robot_at(const Pose2& pose, double stamp = 2.0) {
  world::GroundTruth truth;
  truth.stamp = time_from_seconds(stamp);
  truth.robot_in_world = pose;
  return truth;
}

LaserScan measure(const SimulatedLidar& lidar, const world::GroundTruth& truth) {
  LaserScan scan;
  lidar.measure(truth, scan);
  return scan;
}

TEST(SimulatedLidar, MeasuresToTheWallsOfADrawnRoom) {
  const SimulatedLidar lidar(kCross, room(), {}, 1);
  const LaserScan scan = measure(lidar, robot_at({4.0, 1.0, 0.0}));
  EXPECT_EQ(scan.stamp, time_from_seconds(2.0));
  EXPECT_EQ(scan.frame_id, "laser_link");
  ASSERT_EQ(scan.ranges.size(), 4U);
  EXPECT_FLOAT_EQ(scan.ranges[0], 4.0F);
  EXPECT_FLOAT_EQ(scan.ranges[1], 1.0F);
  EXPECT_FLOAT_EQ(scan.ranges[2], 4.0F);
  EXPECT_FLOAT_EQ(scan.ranges[3], 2.0F);
}

TEST(SimulatedLidar, StandsWhereItIsMounted) {
  // 0.5 m ahead of base_link; the robot looks along y.
  const SimulatedLidar lidar(kCross, room(), {0.5, 0.0, 0.0}, 1);
  const LaserScan scan = measure(lidar, robot_at({4.0, 1.0, kPi / 2}));
  EXPECT_FLOAT_EQ(scan.ranges[2], 1.5F);
  EXPECT_FLOAT_EQ(scan.ranges[0], 1.5F);
  EXPECT_NEAR(scan.ranges[1], 4.0F, 1e-5);
}

TEST(SimulatedLidar, SeesAnimalsBeforeWalls) {
  const SimulatedLidar lidar(kCross, room(), {}, 1);
  world::GroundTruth truth = robot_at({4.0, 1.0, 0.0});
  truth.animals = {{"duck", {6.0, 1.0}, {0, 0}, 0.15}, {"far", {7.5, 1.0}, {0, 0}, 0.15}};
  EXPECT_FLOAT_EQ(measure(lidar, truth).ranges[2], 1.85F);
}

TEST(SimulatedLidar, TooFarTooNearAndLostAreToldApart) {
  SimulatedLidarConfig config = kCross;
  config.range_max = 3.0;
  config.range_min = 1.2;
  const auto truth = robot_at({4.0, 1.0, 0.0});
  const LaserScan scan = measure(SimulatedLidar(config, room(), {}, 1), truth);
  EXPECT_EQ(scan.ranges[2], std::numeric_limits<float>::infinity());
  EXPECT_EQ(scan.ranges[1], -std::numeric_limits<float>::infinity());
  EXPECT_FALSE(scan.is_hit(1));
  EXPECT_TRUE(scan.is_hit(3));
  config.dropout = 1.0;
  const LaserScan lost = measure(SimulatedLidar(config, room(), {}, 1), truth);
  for (const float range : lost.ranges) EXPECT_TRUE(std::isnan(range)) << range;
}

TEST(SimulatedLidar, BeamsGoRoundCounterClockwiseFromBehind) {
  SimulatedLidarConfig config = kCross;
  config.beams = 360;
  const SimulatedLidar lidar(config, room(), {}, 1);
  const LaserScan scan = measure(lidar, robot_at({4.0, 1.5, 0.0}));
  for (std::size_t i = 0; i < 360; ++i) {
    const double angle = -kPi + 2 * kPi * static_cast<double>(i) / 360;
    EXPECT_NEAR(static_cast<double>(scan.angle(i)), angle, 1e-5);
    const double expected =
        std::min(4.0 / std::abs(std::cos(angle)), 1.5 / std::abs(std::sin(angle)));
    EXPECT_NEAR(static_cast<double>(scan.ranges[i]), expected, 1e-4) << i;
  }
}

TEST(SimulatedLidar, NoiseAndDropoutHaveTheirShares) {
  SimulatedLidarConfig config = kCross;
  config.beams = 360;
  config.range_noise = 0.02;
  config.dropout = 0.1;
  const SimulatedLidar noisy(config, room(), {}, 3);
  config.range_noise = 0.0;
  config.dropout = 0.0;
  const SimulatedLidar exact(config, room(), {}, 3);
  int lost = 0;
  int measured = 0;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < 100; ++i) {
    const auto truth = robot_at({4.0, 1.5, 0.0}, 2.0 + 0.1 * i);
    const LaserScan a = measure(noisy, truth);
    const LaserScan b = measure(exact, truth);
    for (std::size_t k = 0; k < 360; ++k) {
      if (!a.is_hit(k)) {
        EXPECT_TRUE(std::isnan(a.ranges[k])) << "every beam meets a wall within reach";
        ++lost;
        continue;
      }
      const double error = static_cast<double>(a.ranges[k] - b.ranges[k]);
      sum += error;
      squares += error * error;
      ++measured;
    }
  }
  EXPECT_NEAR(lost / 36000.0, 0.1, 0.008);  // five deviations
  EXPECT_NEAR(sum / measured, 0.0, 0.0006);
  EXPECT_NEAR(std::sqrt(squares / measured), 0.02, 0.0005);
}

TEST(SimulatedLidar, ARestartedDriverMeasuresTheSame) {
  SimulatedLidarConfig config;
  const SimulatedLidar first(config, room(), {}, 3);
  (void)measure(first, robot_at({4.0, 1.5, 0.0}, 1.9));
  const SimulatedLidar second(config, room(), {}, 3);
  const auto truth = robot_at({4.0, 1.5, 0.0}, 2.0);
  // Some beams are lost, and NaN is not equal to itself.
  EXPECT_THAT(measure(first, truth).ranges,
              testing::Pointwise(testing::NanSensitiveFloatEq(), measure(second, truth).ranges));
}

TEST(SimulatedLidar, SeedsAndStampsAndBeamsDifferInTheirNoise) {
  SimulatedLidarConfig config;
  const SimulatedLidar one(config, room(), {}, 3);
  const SimulatedLidar other(config, room(), {}, 4);
  const auto truth = robot_at({4.0, 1.5, 0.0}, 2.0);
  const LaserScan scan = measure(one, truth);
  EXPECT_NE(scan.ranges, measure(other, truth).ranges);
  EXPECT_NE(scan.ranges, measure(one, robot_at({4.0, 1.5, 0.0}, 2.1)).ranges);
  EXPECT_NE(scan.ranges[180], scan.ranges[0]);  // both walls are 4 m away
}

TEST(SimulatedLidar, NoiseMayGrowWithTheRange) {
  SimulatedLidarConfig config = kCross;
  config.range_noise_share = 0.02;
  const SimulatedLidar lidar(config, room(), {}, 1);
  double squares = 0.0;
  constexpr int kScans = 2000;
  for (int i = 0; i < kScans; ++i) {
    // The beam ahead meets the wall 4 m away.
    const LaserScan scan = measure(lidar, robot_at({4.0, 1.5, 0.0}, 2.0 + 0.1 * i));
    const double error = static_cast<double>(scan.ranges[2]) - 4.0;
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / kScans), 0.08, 0.005);
}

TEST(SimulatedLidar, ItsMountingIsDrawnOnceARun) {
  SimulatedLidarConfig config = kCross;
  config.mount_yaw_spread = 0.05;
  double squares = 0.0;
  constexpr int kRuns = 400;
  for (int seed = 0; seed < kRuns; ++seed) {
    const SimulatedLidar lidar(config, room(), {}, static_cast<std::uint64_t>(seed));
    const double ahead = static_cast<double>(measure(lidar, robot_at({4.0, 1.5, 0.0})).ranges[2]);
    EXPECT_EQ(static_cast<double>(measure(lidar, robot_at({4.0, 1.5, 0.0}, 3.0)).ranges[2]), ahead);
    const double yaw = std::acos(std::min(1.0, 4.0 / ahead));
    squares += yaw * yaw;
  }
  EXPECT_NEAR(std::sqrt(squares / kRuns), 0.05, 0.006);
}

}  // namespace
}  // namespace coop::lidar_driver
