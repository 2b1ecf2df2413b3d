#include "simulator/heap_field.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coop::simulator {
namespace {

using world::HeapState;

/// A blade 0.4 m wide, from 0.38 m to 0.44 m ahead.
const Eigen::AlignedBox2d kBlade(Eigen::Vector2d(0.38, -0.2), Eigen::Vector2d(0.44, 0.2));

class HeapFieldTest : public testing::Test {
 protected:
  /// From pose to pose in steps of 1 cm.
  void drive(const Pose2& from, double metres) {
    const double sign = metres < 0.0 ? -1.0 : 1.0;
    Pose2 before = from;
    for (int i = 1; i <= static_cast<int>(std::abs(metres) * 100.0); ++i) {
      const Pose2 after = from * Pose2{sign * 0.01 * i, 0, 0};
      field_.step(before, after);
      before = after;
    }
  }
  [[nodiscard]] HeapState state(std::size_t index) const { return field_.heaps()[index].state; }

  HeapField field_{kBlade,
                   {{"ahead", {1.0, 0.0}, 0.08, HeapState::kOnFloor},
                    {"grazed", {1.5, 0.15}, 0.08, HeapState::kOnFloor},
                    {"whole", {2.0, -0.11}, 0.08, HeapState::kOnFloor},
                    {"far", {2.0, 1.0}, 0.08, HeapState::kOnFloor}}};
};

TEST_F(HeapFieldTest, WhatTheBladePassesOverIsTakenAndTheRestStays) {
  drive({0, 0, 0}, 0.5);
  EXPECT_EQ(state(0), HeapState::kOnFloor) << "the blade's edge is at 0.94 m";
  drive({0.5, 0, 0}, 1.5);
  EXPECT_EQ(state(0), HeapState::kCleaned);
  EXPECT_EQ(state(1), HeapState::kOnFloor) << "reaches beyond the blade's end";
  EXPECT_EQ(state(2), HeapState::kCleaned);
  EXPECT_EQ(state(3), HeapState::kOnFloor);
}

TEST_F(HeapFieldTest, ABladeDrawnBackwardsTakesNothing) {
  drive({1.2, 0, 0}, -1.0);
  EXPECT_EQ(state(0), HeapState::kOnFloor);
}

TEST_F(HeapFieldTest, TheBladeTurnsWithTheRobot) {
  drive({2.0, 0.2, std::numbers::pi / 2}, 0.6);
  EXPECT_EQ(state(3), HeapState::kCleaned);
  EXPECT_EQ(state(2), HeapState::kOnFloor);
}

TEST(HeapField, ARobotWithoutBladeTakesNothing) {
  HeapField field({}, {{"here", {0.5, 0.0}, 0.05, HeapState::kOnFloor}});
  for (int i = 0; i < 100; ++i) field.step({0.01 * i, 0, 0}, {0.01 * (i + 1), 0, 0});
  EXPECT_EQ(field.heaps()[0].state, HeapState::kOnFloor);
}

}  // namespace
}  // namespace coop::simulator
