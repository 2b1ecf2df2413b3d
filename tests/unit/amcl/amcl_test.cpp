#include "amcl/amcl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/config/error.hpp"
#include "support/simulated_room.hpp"

namespace coop::amcl {
namespace {

using test::barn;

const OccupancyGrid& barn_map() {
  static const OccupancyGrid map = test::mapped(barn());
  return map;
}
using test::SimulatedDrive;

PoseEstimate around(const Pose2& pose, double stddev, double yaw_stddev) {
  PoseEstimate belief{pose, Eigen::Matrix3d::Zero()};
  belief.covariance.diagonal() << stddev * stddev, stddev * stddev, yaw_stddev * yaw_stddev;
  return belief;
}

double position_error(const Estimate& estimate, const SimulatedDrive& truth) {
  return distance(estimate.robot_in_map.pose, truth.base_in_map);
}

/// Drives the tour; returns the seconds until the pose is known and right, or -1.
double seconds_until_localised(Amcl& amcl, SimulatedDrive& drive, double limit) {
  for (int step = 0; step * 0.1 < limit; ++step) {
    drive.follow_tour();
    const auto estimate = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
    if (estimate && estimate->localised && position_error(*estimate, drive) < 0.15)
      return step * 0.1;
  }
  return -1.0;
}

TEST(Amcl, SaysNothingBeforeItWasToldWhereToStart) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  Amcl amcl({}, barn_map(), 1);
  EXPECT_FALSE(amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom).has_value());
}

TEST(Amcl, TracksTheRobotThroughTheBarn) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulatedDrive drive(barn(), {2, 1.5, 0}, seed);
    Amcl amcl({}, barn_map(), seed);
    amcl.set_pose(around({2.2, 1.3, 0.1}, 0.3, 0.15));
    double sum = 0.0;
    double worst = 0.0;
    int count = 0;
    for (int step = 0; step < 900; ++step) {
      drive.follow_tour();
      const auto estimate = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
      ASSERT_TRUE(estimate);
      if (step < 50) continue;
      EXPECT_TRUE(estimate->localised);
      EXPECT_LE(estimate->particles, 3000u);
      const double error = position_error(*estimate, drive);
      sum += error * error;
      worst = std::max(worst, error);
      ++count;
      EXPECT_LT(std::abs(angle_difference(estimate->robot_in_map.pose.yaw, drive.base_in_map.yaw)),
                0.06);
    }
    EXPECT_LT(std::sqrt(sum / count), 0.04) << "seed " << seed;
    EXPECT_LT(worst, 0.12) << "seed " << seed;
    RecordProperty("rms_mm_seed_" + std::to_string(seed),
                   static_cast<int>(1000 * std::sqrt(sum / count)));
  }
}

TEST(Amcl, FindsTheRobotFromNothing) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulatedDrive drive(barn(), {7, 3, 1.4}, seed);
    Amcl amcl({}, barn_map(), seed);
    ASSERT_TRUE(amcl.scatter());
    const double time = seconds_until_localised(amcl, drive, 40.0);
    EXPECT_GE(time, 0.0) << "not found, seed " << seed;
    RecordProperty("seconds_seed_" + std::to_string(seed), static_cast<int>(time * 10));
  }
}

TEST(Amcl, FindsTheRobotWhileItStands) {
  SimulatedDrive drive(barn(), {7, 2, 1.4}, 5);
  Amcl amcl({}, barn_map(), 5);
  ASSERT_TRUE(amcl.scatter());
  std::optional<Estimate> estimate;
  for (int i = 0; i < 100; ++i) {
    drive.wait();
    estimate = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
  }
  ASSERT_TRUE(estimate->localised);
  EXPECT_FALSE(estimate->updated);
  EXPECT_LT(position_error(*estimate, drive), 0.08);
}

/// Scans until a standing robot is known to be where it is; -1: never.
int scans_until_found(Amcl& amcl, SimulatedDrive& drive, int limit) {
  for (int i = 0; i < limit; ++i) {
    drive.wait();
    const auto estimate = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
    if (estimate && estimate->localised && position_error(*estimate, drive) < 0.15) return i;
  }
  return -1;
}

TEST(Amcl, AStandingRobotThatWasToldAWrongPoseFindsOut) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulatedDrive drive(barn(), {7, 2, 1.4}, seed);
    Amcl amcl({}, barn_map(), seed);
    amcl.set_pose(around({12.0, 7.5, 2.0}, 0.1, 0.05));
    EXPECT_GE(scans_until_found(amcl, drive, 100), 0) << "seed " << seed;
  }
}

TEST(Amcl, AStandingRobotThatWasCarriedAwayFindsOut) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  Amcl amcl({}, barn_map(), 1);
  amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
  ASSERT_GE(scans_until_found(amcl, drive, 20), 0);
  for (int i = 0; i < 20; ++i) {
    drive.wait();
    (void)amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
  }
  drive.base_in_map = {10.5, 7.2, 2.5};  // odometry did not see it
  EXPECT_GE(scans_until_found(amcl, drive, 200), 0);
}

/// A room of 6 m x 4 m with walls of 10 cm, which looks the same from two places half a turn apart.
OccupancyGrid plain_room(double resolution) {
  const auto cells = [resolution](double way) {
    return static_cast<int>(std::lround(way / resolution));
  };
  OccupancyGrid room({cells(6.2), cells(4.2), resolution, {-0.1, -0.1}}, kOccupied);
  for (int y = cells(0.1); y < cells(4.1); ++y) {
    for (int x = cells(0.1); x < cells(6.1); ++x) room[{x, y}] = kFree;
  }
  return room;
}

TEST(Amcl, WhereTwoPlacesLookAlikeAStandingRobotDoesNotChooseOne) {
  for (const std::uint64_t seed : {1, 2}) {
    SimulatedDrive drive(plain_room(0.01), {2.0, 1.2, 0.4}, seed);
    Amcl amcl({}, plain_room(0.05), seed);
    ASSERT_TRUE(amcl.scatter());
    int localised = 0;
    std::optional<Estimate> last;
    for (int i = 0; i < 100; ++i) {
      drive.wait();
      last = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
      localised += last->localised ? 1 : 0;
    }
    EXPECT_EQ(localised, 0) << "seed " << seed;
    EXPECT_TRUE(last->updated) << "it goes on searching";
    EXPECT_EQ(last->doubt, Doubt::kSeveralPlaces);
    const Pose2 other{6.0 - 2.0, 4.0 - 1.2, 0.4 - std::numbers::pi};
    EXPECT_LT(std::min(position_error(*last, drive), distance(last->robot_in_map.pose, other)),
              0.2);
  }
}

TEST(Amcl, WhereTheMapIsThatOfAnotherHouseItSaysSo) {
  SimulatedDrive drive(plain_room(0.01), {2.0, 1.2, 0.4}, 1);
  Amcl amcl({}, barn_map(), 1);
  amcl.set_pose(around({7, 4, 0}, 0.1, 0.05));
  std::optional<Estimate> last;
  for (int i = 0; i < 60; ++i) {
    drive.wait();
    last = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
  }
  EXPECT_FALSE(last->localised) << last->fit << " " << last->cluster_share;
}

TEST(Amcl, RecoversWhenTheRobotWasCarriedAway) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulatedDrive drive(barn(), {2, 1.5, 0}, seed);
    Amcl amcl({}, barn_map(), seed);
    amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
    for (int step = 0; step < 100; ++step) {
      drive.follow_tour();
      (void)amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
    }
    ASSERT_TRUE(amcl.localised());
    drive.base_in_map = {10.5, 7.2, 2.5};
    EXPECT_GE(seconds_until_localised(amcl, drive, 60.0), 0.0) << "seed " << seed;
  }
}

TEST(Amcl, StandingStillIsNoEvidence) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  AmclConfig config;
  config.settle_updates = 3;
  Amcl amcl(config, barn_map(), 1);
  amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
  std::optional<Estimate> last;
  for (int i = 0; i < 200; ++i) {
    drive.wait();
    const auto estimate = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
    ASSERT_TRUE(estimate);
    EXPECT_EQ(estimate->updated, i < 4) << "the first scan and the few that settle the pose";
    if (!estimate->updated) {
      EXPECT_LT(distance(estimate->robot_in_map.pose, last->robot_in_map.pose), 1e-9);
      EXPECT_EQ(estimate->robot_in_map.covariance, last->robot_in_map.covariance);
    }
    last = estimate;
  }
}

TEST(Amcl, BetweenUpdatesThePoseFollowsTheOdometry) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  AmclConfig config;
  config.settle_updates = 0;
  Amcl amcl(config, barn_map(), 1);
  amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
  const auto first = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
  drive.drive(0.3, 0.0);  // 3 cm, below the threshold
  const auto second = amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(second->updated);
  EXPECT_NEAR(distance(second->robot_in_map.pose, first->robot_in_map.pose), 0.03, 0.01);
  const Pose2 composed = second->odom_in_map * drive.base_in_odom;
  EXPECT_NEAR(distance(composed, second->robot_in_map.pose), 0.0, 1e-9);
}

TEST(Amcl, OdometryThatStartsAgainAtZeroDoesNotMoveTheParticles) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  Amcl amcl({}, barn_map(), 1);
  amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
  OdometryTrack track;
  const auto step = [&](const char* source) {
    drive.follow_tour();
    track.insert({drive.stamp, drive.base_in_odom}, source);
    return amcl.update(drive.scan(), drive.laser_in_base, *track.at(drive.stamp));
  };
  for (int i = 0; i < 60; ++i) (void)step("one");
  drive.base_in_odom = {0, 0, 0};  // the chassis driver was restarted, the robot rolled on
  drive.base_in_map = drive.base_in_map * Pose2{0.15, 0.02, 0.1};
  int right = 0;
  for (int i = 0; i < 60; ++i) {
    const auto estimate = step("two");
    ASSERT_TRUE(estimate);
    EXPECT_TRUE(estimate->localised);
    EXPECT_LT(position_error(*estimate, drive), 0.25);
    right += position_error(*estimate, drive) < 0.1 ? 1 : 0;
  }
  EXPECT_GT(right, 50) << "after a few scans the pose is what it was before";
}

TEST(Amcl, AScanThatIsNotNewerSaysNothing) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  Amcl amcl({}, barn_map(), 1);
  amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
  ASSERT_TRUE(amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom));
  EXPECT_FALSE(amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom));
}

TEST(Amcl, AScanWithoutBeamsMovesTheParticlesButLeavesTheWeights) {
  SimulatedDrive drive(barn(), {2, 1.5, 0}, 1);
  Amcl amcl({}, barn_map(), 1);
  amcl.set_pose(around({2, 1.5, 0}, 0.1, 0.05));
  ASSERT_TRUE(amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom));
  const auto weights = amcl.particles().weight;
  drive.drive(0.5, 0.0, 1.0);
  LaserScan blind = drive.scan();
  std::fill(blind.ranges.begin(), blind.ranges.end(), std::numeric_limits<float>::infinity());
  const auto estimate = amcl.update(blind, drive.laser_in_base, drive.base_in_odom);
  ASSERT_TRUE(estimate);
  EXPECT_EQ(amcl.particles().weight, weights);
  EXPECT_NEAR(estimate->robot_in_map.pose.x, 2.5, 0.15);
}

TEST(Amcl, OneSeedGivesOneResult) {
  const auto run = [](std::uint64_t seed) {
    SimulatedDrive drive(barn(), {7, 3, 1.4}, 4);
    Amcl amcl({}, barn_map(), seed);
    (void)amcl.scatter();
    for (int step = 0; step < 30; ++step) {
      drive.follow_tour();
      (void)amcl.update(drive.scan(), drive.laser_in_base, drive.base_in_odom);
    }
    return amcl.particles().x;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(Amcl, StartsFromACovarianceWithCorrelation) {
  Amcl amcl({}, barn_map(), 1);
  PoseEstimate belief{{5, 5, 0.3}, Eigen::Matrix3d::Zero()};
  belief.covariance << 0.04, 0.03, 0.0, 0.03, 0.05, 0.0, 0.0, 0.0, 0.01;
  amcl.set_pose(belief);
  const ParticleSet& particles = amcl.particles();
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector2d offset = particles.pose(i).position() - Eigen::Vector2d{5, 5};
    xx += offset.x() * offset.x();
    xy += offset.x() * offset.y();
    yy += offset.y() * offset.y();
  }
  const auto n = static_cast<double>(particles.size());
  EXPECT_NEAR(xx / n, 0.04, 0.005);
  EXPECT_NEAR(xy / n, 0.03, 0.005);
  EXPECT_NEAR(yy / n, 0.05, 0.006);
}

TEST(Amcl, CannotScatterWhereNothingIsFree) {
  Amcl amcl({}, OccupancyGrid({10, 10, 0.1, {0, 0}}, kUnknown), 1);
  EXPECT_FALSE(amcl.scatter());
}

TEST(AmclConfig, RefusesLimitsThatContradictEachOther) {
  AmclConfig config;
  config.kld.min_particles = config.kld.max_particles + 1;
  EXPECT_THROW(config.validate(), config::Error);
  config = {};
  config.lost_stddev = config.localised_stddev;
  EXPECT_THROW(config.validate(), config::Error);
}

}  // namespace
}  // namespace coop::amcl
