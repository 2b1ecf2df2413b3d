#include "core/vehicle/drive_controller.hpp"

#include <gtest/gtest.h>

#include "unit/core_vehicle/base.hpp"

namespace coop::vehicle {
namespace {

using test::kBase;
constexpr Duration kTick = std::chrono::milliseconds(10);

/// Drives a controller with one command repeated at every tick.
class DriveControllerTest : public testing::Test {
 protected:
  void run(int ticks, Twist2 command) {
    for (int i = 0; i < ticks; ++i) {
      controller_.gate().accept(command, now_);
      step();
    }
  }
  void run_silent(int ticks) {
    for (int i = 0; i < ticks; ++i) step();
  }
  void step() {
    now_ += kTick;
    controller_.step(now_, kTick);
  }
  [[nodiscard]] double speed() const { return controller_.setpoint().speed; }

  DriveController controller_{DriveConfig{}, kBase};
  Time now_ = time_from_seconds(1.0);
};

TEST_F(DriveControllerTest, AcceleratesAtTheLimit) {
  run(100, {0.6, 0.0});  // 1 s at 0.5 m/s^2
  EXPECT_NEAR(speed(), 0.5, 1e-9);
  run(100, {0.6, 0.0});
  EXPECT_DOUBLE_EQ(speed(), 0.6);
}

TEST_F(DriveControllerTest, ClampsTheSpeedForwardAndBackward) {
  run(300, {5.0, 0.0});
  EXPECT_DOUBLE_EQ(speed(), 0.6);
  run(500, {-5.0, 0.0});
  EXPECT_DOUBLE_EQ(speed(), -0.3);
}

TEST_F(DriveControllerTest, ReversesByWayOfStandstill) {
  run(200, {0.4, 0.0});
  run(49, {-0.2, 0.0});  // braking from 0.4 at 0.8 m/s^2 takes 50 ticks
  EXPECT_GT(speed(), 0.0);
  run(1, {-0.2, 0.0});
  EXPECT_NEAR(speed(), 0.0, 1e-9);
  run(20, {-0.2, 0.0});  // then 0.5 m/s^2 backwards
  EXPECT_NEAR(speed(), -0.1, 1e-9);
}

TEST_F(DriveControllerTest, TheWatchdogBringsTheBaseToRest) {
  run(200, {0.6, 0.0});
  run_silent(29);  // the last command came one tick ago
  EXPECT_DOUBLE_EQ(speed(), 0.6);
  EXPECT_EQ(controller_.setpoint().cause, DriveCause::kCommand);
  run_silent(1);
  EXPECT_EQ(controller_.setpoint().cause, DriveCause::kCommandStale);
  EXPECT_NEAR(speed(), 0.6 - 0.015, 1e-9);
  run_silent(39);  // 0.6 m/s at 1.5 m/s^2: 40 ticks
  EXPECT_NEAR(speed(), 0.0, 1e-9);
}

TEST_F(DriveControllerTest, AnEmergencyStopBrakesAtOnceAndKeepsTheWheelsAngle) {
  run(200, {0.4, 0.2});
  const double steering = controller_.setpoint().steering;
  controller_.gate().emergency_stops().set("person", true, "button");
  run(10, {0.4, -0.2});
  EXPECT_NEAR(speed(), 0.4 - 10 * 0.015, 1e-9);
  EXPECT_DOUBLE_EQ(controller_.setpoint().steering, steering);
}

TEST_F(DriveControllerTest, TheSteeringTurnsAtItsRate) {
  run(25, {0.1, 0.1});  // curvature 1: atan(0.5) = 0.4636 rad, at 0.8 rad/s
  EXPECT_NEAR(controller_.setpoint().steering, 0.2, 1e-9);
  run(100, {0.1, 0.1});
  EXPECT_NEAR(controller_.setpoint().steering, std::atan(0.5), 1e-12);
}

}  // namespace
}  // namespace coop::vehicle
