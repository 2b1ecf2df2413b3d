#include "dwa/dynamic_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/dwa/test_base.hpp"

namespace coop::dwa {
namespace {

using test::kSteeringRate;
using test::test_base;

std::vector<Command> sample(const MotionState& now, double low, double high, double wish = 0.0,
                            const WindowConfig& config = {
                                .window_time = 0.2, .speed_samples = 3, .steering_samples = 5}) {
  std::vector<Command> commands;
  DynamicWindow(config, 0.5, test_base(), kSteeringRate).sample(now, low, high, wish, commands);
  return commands;
}

TEST(DynamicWindow, IsTheProductOfSpeedsAndSteeringAngles) {
  const auto commands = sample({0.3, 0.0}, 0.0, 0.6);
  ASSERT_EQ(commands.size(), 3U * (5U + 1U));  // five samples and the wish
  // 0.3 m/s -+ 0.5 m/s2 * 0.2 s in three steps
  EXPECT_NEAR(commands[0].speed, 0.2, 1e-12);
  EXPECT_NEAR(commands[6].speed, 0.3, 1e-12);
  EXPECT_NEAR(commands[12].speed, 0.4, 1e-12);
  // 0.8 rad/s * 0.2 s = 0.16 rad to both sides in five steps
  EXPECT_NEAR(commands[0].steering, -0.16, 1e-12);
  EXPECT_NEAR(commands[1].steering, -0.08, 1e-12);
  EXPECT_NEAR(commands[4].steering, 0.16, 1e-12);
}

TEST(DynamicWindow, SpeedLimitsCutTheWindow) {
  for (const Command& command : sample({0.55, 0.0}, 0.0, 0.6)) {
    EXPECT_GE(command.speed, 0.45 - 1e-12);
    EXPECT_LE(command.speed, 0.6 + 1e-12);
  }
}

TEST(DynamicWindow, TooFastForTheLimitOnlyTheHardestBrakingIsLeft) {
  const auto commands = sample({0.5, 0.0}, 0.0, 0.1);
  ASSERT_EQ(commands.size(), 6U);
  for (const Command& command : commands) EXPECT_NEAR(command.speed, 0.4, 1e-12);
}

TEST(DynamicWindow, NeverLeavesTheSteeringLimitSoTheTurningRadiusHolds) {
  for (const Command& command : sample({0.3, 0.58}, 0.0, 0.6)) {
    EXPECT_LE(std::abs(command.steering), 0.60 + 1e-12);
    const Twist2 twist = vehicle::twist_of(test_base(), command.speed, command.steering);
    EXPECT_LE(std::abs(twist.omega), std::abs(twist.v) / 0.80 + 1e-3);
  }
}

TEST(DynamicWindow, TheWishIsSampledAndClampedToWhatCanBeReached) {
  EXPECT_NEAR(sample({0.3, 0.0}, 0.0, 0.6, 0.05)[5].steering, 0.05, 1e-12);
  EXPECT_NEAR(sample({0.3, 0.0}, 0.0, 0.6, 0.50)[5].steering, 0.16, 1e-12);
}

TEST(DynamicWindow, WorksBackwards) {
  for (const Command& command : sample({-0.1, 0.0}, -0.3, -0.05)) {
    EXPECT_LE(command.speed, -0.05 + 1e-12);
    EXPECT_GE(command.speed, -0.2 - 1e-12);
  }
}

}  // namespace
}  // namespace coop::dwa
