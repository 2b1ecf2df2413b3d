#include "experiments/chaos/fault.hpp"

#include <gtest/gtest.h>

#include <map>

namespace coop::chaos {
namespace {

const std::vector<std::string> kComponents{"simulator", "lidar_driver", "amcl", "dwa"};

TEST(FaultPlan, OneSeedIsOneRowOfFaults) {
  FaultPlan one(7, kComponents, {true, true}, 10.0);
  FaultPlan same(7, kComponents, {true, true}, 10.0);
  FaultPlan other(8, kComponents, {true, true}, 10.0);
  int differing = 0;
  for (int i = 0; i < 100; ++i) {
    const Fault a = one.next();
    const Fault b = same.next();
    const Fault c = other.next();
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.component, b.component);
    EXPECT_EQ(a.duration, b.duration);
    EXPECT_EQ(a.gap, b.gap);
    differing += a.kind != c.kind || a.component != c.component;
  }
  EXPECT_GT(differing, 50);
}

TEST(FaultPlan, EveryKindMeetsEveryComponent) {
  FaultPlan plan(1, kComponents, {true, true}, 10.0);
  std::map<FaultKind, std::map<std::string, int>> counts;
  for (int i = 0; i < 1000; ++i) {
    const Fault fault = plan.next();
    ++counts[fault.kind][fault.component];
    EXPECT_GE(fault.gap, 5.0);
    EXPECT_LE(fault.gap, 15.0);
    if (fault.kind == FaultKind::kKill) {
      EXPECT_EQ(fault.duration, 0.0);
    } else if (fault.kind != FaultKind::kClock) {
      EXPECT_GT(fault.duration, 0.2) << name_of(fault.kind);
    }
  }
  EXPECT_EQ(counts.size(), static_cast<std::size_t>(kFaultKinds));
  for (const FaultKind kind :
       {FaultKind::kKill, FaultKind::kStop, FaultKind::kSlow, FaultKind::kLoss, FaultKind::kCut}) {
    EXPECT_EQ(counts[kind].size(), kComponents.size()) << name_of(kind);
  }
  EXPECT_TRUE(counts[FaultKind::kDiskFull].contains(""));
}

TEST(FaultPlan, WhatTheMachineDoesNotAllowIsLeftOut) {
  FaultPlan plan(1, kComponents, {false, false}, 10.0);
  for (int i = 0; i < 500; ++i) {
    const FaultKind kind = plan.next().kind;
    EXPECT_NE(kind, FaultKind::kLoss);
    EXPECT_NE(kind, FaultKind::kCut);
    EXPECT_NE(kind, FaultKind::kDiskFull);
  }
}

TEST(Faults, TheRobotMustStopForWhatItDrivesBy) {
  EXPECT_TRUE(is_needed_to_drive({.kind = FaultKind::kKill, .component = "dwa"}));
  EXPECT_TRUE(is_needed_to_drive({.kind = FaultKind::kCut, .component = "lidar_driver"}));
  EXPECT_TRUE(is_needed_to_drive({.kind = FaultKind::kStop, .component = "amcl"}));
  EXPECT_FALSE(is_needed_to_drive({.kind = FaultKind::kKill, .component = "camera_driver"}));
  EXPECT_FALSE(is_needed_to_drive({.kind = FaultKind::kLoss, .component = "dwa"}));
}

}  // namespace
}  // namespace coop::chaos
