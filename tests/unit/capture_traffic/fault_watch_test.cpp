#include "capture/traffic/fault_watch.hpp"

#include <gtest/gtest.h>

namespace coop::capture {
namespace {

using State = FaultWatch::State;

TEST(FaultWatch, ADegradationIsAFaultOfThoseThatWereAtWorkOnly) {
  FaultWatch watch;
  EXPECT_FALSE(watch.heartbeat("amcl", State::kStarting, ""));
  EXPECT_FALSE(watch.heartbeat("amcl", State::kReady, "")) << "for a moment";
  EXPECT_FALSE(watch.heartbeat("amcl", State::kDegraded, "no scan"));
  for (int i = 0; i < FaultWatch::kAtWork; ++i) {
    EXPECT_FALSE(watch.heartbeat("amcl", State::kReady, ""));
  }
  EXPECT_EQ(watch.heartbeat("amcl", State::kDegraded, "no scan"), "amcl degraded: no scan");
  EXPECT_FALSE(watch.heartbeat("amcl", State::kDegraded, "no scan")) << "told already";
}

TEST(FaultWatch, WhoDisappearsWithoutAWordHasDied) {
  FaultWatch watch;
  EXPECT_FALSE(watch.heartbeat("dwa", State::kReady, ""));
  EXPECT_EQ(watch.gone("dwa"), "dwa died");
  EXPECT_FALSE(watch.gone("dwa"));
  EXPECT_FALSE(watch.heartbeat("slam", State::kStopping, ""));
  EXPECT_FALSE(watch.gone("slam"));
  EXPECT_FALSE(watch.heartbeat("play", State::kFinished, ""));
  EXPECT_FALSE(watch.gone("play"));
}

TEST(FaultWatch, AnEmergencyStopCountsWhenASourceEngagesIt) {
  FaultWatch watch;
  EXPECT_FALSE(watch.emergency_stop("button", false, ""));
  EXPECT_EQ(watch.emergency_stop("button", true, "pressed"), "emergency stop by button: pressed");
  EXPECT_FALSE(watch.emergency_stop("button", true, "pressed"));
  EXPECT_FALSE(watch.emergency_stop("button", false, ""));
  EXPECT_TRUE(watch.emergency_stop("button", true, ""));
}

}  // namespace
}  // namespace coop::capture
