#include "core/vehicle/wheel_odometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "unit/core_vehicle/base.hpp"

namespace coop::vehicle {
namespace {

using test::kBase;

WheelReading reading(double s, std::int64_t left, std::int64_t right, double steering) {
  return {time_from_seconds(s), left, right, steering};
}

TEST(WheelOdometry, TheFirstReadingIsTheReference) {
  WheelOdometry odometry({}, kBase, {1, 2, 0.5});
  odometry.update(reading(1.0, 123456, -98765, 0.3));
  EXPECT_EQ(odometry.odometry().base_in_odom, (Pose2{1, 2, 0.5}));
  EXPECT_EQ(odometry.odometry().velocity, Twist2{});
}

TEST(WheelOdometry, StraightTicksAddUpToMetres) {
  WheelOdometry odometry({.metres_per_tick = 0.001, .noise = {}}, kBase);
  odometry.update(reading(1.0, 100, 200, 0.0));
  odometry.update(reading(1.5, 350, 450, 0.0));
  EXPECT_NEAR(odometry.odometry().base_in_odom.x, 0.25, 1e-12);
  EXPECT_NEAR(odometry.odometry().velocity.v, 0.5, 1e-12);
  EXPECT_EQ(odometry.odometry().stamp, time_from_seconds(1.5));
}

TEST(WheelOdometry, ASteeredQuarterCircleEndsWhereItMust) {
  // Curvature 1: radius 1 m. Rear wheels on 0.8 and 1.2 m; the quarter circle of base_link is pi/2
  // m.
  WheelOdometry odometry({.metres_per_tick = 1e-6, .noise = {}}, kBase);
  const double steering = std::atan(0.5);
  odometry.update(reading(1.0, 0, 0, steering));
  for (int i = 1; i <= 10; ++i) {
    odometry.update(
        reading(1.0 + 0.1 * i, static_cast<std::int64_t>(0.8e6 * std::numbers::pi / 20 * i),
                static_cast<std::int64_t>(1.2e6 * std::numbers::pi / 20 * i), steering));
  }
  EXPECT_NEAR(odometry.odometry().base_in_odom.x, 1.0, 1e-5);
  EXPECT_NEAR(odometry.odometry().base_in_odom.y, 1.0, 1e-5);
  EXPECT_NEAR(odometry.odometry().base_in_odom.yaw, std::numbers::pi / 2, 1e-5);
  EXPECT_NEAR(odometry.odometry().velocity.omega, std::numbers::pi / 2, 1e-4);
}

TEST(OdometryIntegrator, CovarianceOfAStraightLineFollowsByHand) {
  // 4 m straight in one step: along 0.02 * sqrt(4); yaw 0.01 * sqrt(4), which at the middle of the
  // step moves y by 2 m.
  OdometryIntegrator integrator(
      {.translation_per_metre = 0.02, .rotation_per_radian = 0.5, .rotation_per_metre = 0.01});
  integrator.advance(4.0, 0.0, time_from_seconds(1));
  const Eigen::Matrix3d& covariance = integrator.covariance();
  EXPECT_NEAR(covariance(0, 0), 0.04 * 0.04, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.02 * 0.02, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.04 * 0.04, 1e-12);
  EXPECT_NEAR(covariance(1, 2), 2.0 * 0.02 * 0.02, 1e-12);
}

TEST(OdometryIntegrator, CovarianceStaysSymmetricAndPositiveOnALongDrive) {
  OdometryIntegrator integrator;
  for (int i = 0; i < 5000; ++i) {
    integrator.advance(0.01, 0.01 * std::sin(0.002 * i), time_from_seconds(1 + 0.02 * i));
  }
  const Eigen::Matrix3d& covariance = integrator.covariance();
  EXPECT_NEAR((covariance - covariance.transpose()).norm(), 0.0, 1e-12);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().minCoeff(), 0);
}

TEST(OdometryIntegrator, StandingStillAddsNoUncertainty) {
  OdometryIntegrator integrator;
  for (int i = 1; i < 100; ++i) integrator.advance(0.0, 0.0, time_from_seconds(i));
  EXPECT_EQ(integrator.covariance().norm(), 0.0);
}

}  // namespace
}  // namespace coop::vehicle
