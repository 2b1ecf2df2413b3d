#include "core/vehicle/command_gate.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coop::vehicle {
namespace {

Time at(double s) {
  return time_from_seconds(s);
}

TEST(CommandGate, StandsStillBeforeTheFirstCommand) {
  const CommandGate gate;
  const auto decision = gate.decide(at(10.0));
  EXPECT_EQ(decision.cause, DriveCause::kNoCommand);
  EXPECT_EQ(decision.command, Twist2{});
}

TEST(CommandGate, LetsACommandThroughForExactlyTheTimeout) {
  CommandGate gate({.command_timeout = 0.3});
  EXPECT_TRUE(gate.accept({0.4, 0.1}, at(10.0)));
  EXPECT_EQ(gate.decide(at(10.3)).cause, DriveCause::kCommand);
  EXPECT_EQ(gate.decide(at(10.3)).command, (Twist2{0.4, 0.1}));
  const auto late = gate.decide(at(10.3) + Duration(1));
  EXPECT_EQ(late.cause, DriveCause::kCommandStale);
  EXPECT_EQ(late.command, Twist2{});
}

TEST(CommandGate, AClockSetBackMakesNoCommandYoungAgain) {
  CommandGate gate({.command_timeout = 0.3});
  EXPECT_TRUE(gate.accept({0.4, 0.1}, at(3600.0)));
  EXPECT_EQ(gate.decide(at(10.0)).cause, DriveCause::kCommandStale);
  EXPECT_TRUE(gate.accept({0.4, 0.1}, at(10.0)));
  EXPECT_EQ(gate.decide(at(10.1)).cause, DriveCause::kCommand);
}

TEST(CommandGate, ANewCommandRevivesTheBase) {
  CommandGate gate;
  gate.accept({0.4, 0.0}, at(1.0));
  EXPECT_EQ(gate.decide(at(2.0)).cause, DriveCause::kCommandStale);
  gate.accept({0.2, 0.0}, at(2.0));
  EXPECT_EQ(gate.decide(at(2.1)).command, (Twist2{0.2, 0.0}));
}

TEST(CommandGate, RefusesWhatIsNotANumberAndLetsTheWatchdogRun) {
  CommandGate gate;
  gate.accept({0.4, 0.0}, at(1.0));
  EXPECT_FALSE(gate.accept({std::numeric_limits<double>::quiet_NaN(), 0.0}, at(1.2)));
  EXPECT_FALSE(gate.accept({0.1, std::numeric_limits<double>::infinity()}, at(1.2)));
  EXPECT_EQ(gate.decide(at(1.25)).command, (Twist2{0.4, 0.0}));
  EXPECT_EQ(gate.decide(at(1.4)).cause, DriveCause::kCommandStale);
}

TEST(CommandGate, AnEmergencyStopOverridesFreshCommandsUntilItsOwnSourceReleasesIt) {
  CommandGate gate;
  gate.accept({0.4, 0.0}, at(1.0));
  gate.emergency_stops().set("dashboard", true, "person in the pen");
  gate.emergency_stops().set("bumper", true, "contact");
  EXPECT_EQ(gate.decide(at(1.0)).cause, DriveCause::kEmergencyStop);
  EXPECT_EQ(gate.decide(at(1.0)).command, Twist2{});

  gate.emergency_stops().set("dashboard", false, "");
  EXPECT_EQ(gate.decide(at(1.1)).cause, DriveCause::kEmergencyStop);
  EXPECT_EQ(gate.emergency_stops().description(), "bumper: contact");

  gate.emergency_stops().set("bumper", false, "");
  EXPECT_EQ(gate.decide(at(1.1)).command, (Twist2{0.4, 0.0}));
}

TEST(CommandGate, AReleaseBySomebodyWhoNeverStoppedChangesNothing) {
  CommandGate gate;
  gate.emergency_stops().set("bumper", true, "contact");
  gate.emergency_stops().set("stranger", false, "");
  EXPECT_TRUE(gate.emergency_stops().engaged());
}

}  // namespace
}  // namespace coop::vehicle
