#include "chassis_driver/chassis.hpp"

#include <gtest/gtest.h>

#include "chassis_driver/loopback_base.hpp"

namespace coop::chassis_driver {
namespace {

using namespace std::chrono_literals;

const vehicle::AckermannGeometry kGeometry{.wheelbase = 0.5,
                                           .track = 0.4,
                                           .wheel_radius = 0.1,
                                           .max_steering_angle = 0.6,
                                           .max_steering_rate = 0.8};

class ChassisTest : public testing::Test {
 protected:
  void run(const Twist2& command, Duration duration) {
    for (Duration done{0}; done < duration; done += 20ms) {
      chassis_.gate().accept(command, now_);
      step();
    }
  }
  void step() {
    now_ += 20ms;
    chassis_.step(now_);
  }
  [[nodiscard]] const Odometry& odometry() const { return chassis_.odometry().odometry(); }

  Time now_ = time_from_seconds(100.0);
  Chassis chassis_{ChassisConfig{}, kGeometry, std::make_unique<LoopbackBase>(kGeometry, 0.0005)};
};

TEST_F(ChassisTest, TheFirstCycleMovesNothing) {
  chassis_.gate().accept({0.5, 0.0}, now_);
  step();
  EXPECT_EQ(odometry().base_in_odom, Pose2{});
  EXPECT_EQ(odometry().stamp, now_);
}

TEST_F(ChassisTest, ALoopbackDrivesTheDistanceItsSpeedSays) {
  run({0.5, 0.0},
      3020ms);  // one cycle of reference, then 1 s of acceleration (0.25 m), 2 s at 0.5 m/s
  EXPECT_NEAR(odometry().base_in_odom.x, 1.25, 0.001);
  EXPECT_NEAR(odometry().base_in_odom.y, 0.0, 1e-9);
  EXPECT_NEAR(odometry().velocity.v, 0.5, 0.026);  // half a millimetre a tick, 20 ms a cycle
}

TEST_F(ChassisTest, ALoopbackDrivesTheCircleOfItsCommand) {
  run({0.4, 0.4}, 2s);  // radius 1 m, once up to speed
  const Pose2 from = odometry().base_in_odom;
  run({0.4, 0.4}, 5s);
  const Pose2 moved = from.inverse() * odometry().base_in_odom;
  EXPECT_NEAR(moved.yaw, 2.0, 0.01);
  EXPECT_NEAR(moved.x, std::sin(2.0), 0.01);
  EXPECT_NEAR(moved.y, 1.0 - std::cos(2.0), 0.01);
}

TEST_F(ChassisTest, StopsWhenCommandsCease) {
  run({0.5, 0.0}, 2s);
  for (int i = 0; i < 40; ++i) step();
  EXPECT_EQ(chassis_.setpoint().cause, vehicle::DriveCause::kCommandStale);
  EXPECT_EQ(odometry().velocity.v, 0.0);
}

TEST_F(ChassisTest, ALongGapBetweenCyclesIsNoLeap) {
  run({0.5, 0.0}, 2s);
  const double before = odometry().base_in_odom.x;
  now_ += 10s;
  chassis_.step(now_);
  EXPECT_LT(odometry().base_in_odom.x - before, 0.11);  // 0.2 s at 0.5 m/s
}

}  // namespace
}  // namespace coop::chassis_driver
