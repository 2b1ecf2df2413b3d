#include "referee/legs.hpp"

#include <gtest/gtest.h>

namespace coop::referee {
namespace {

/// A robot that starts at (1, 2) in the world, which is the map's origin, and drives along x.
class LegsTest : public ::testing::Test {
 protected:
  LegsTest() {
    legs_.begin({1.0, 2.0, 0.0});
    see(0.0, 0.0);
  }
  void see(double seconds, double x_in_map, std::uint32_t collisions = 0) {
    world::GroundTruth truth;
    truth.stamp = time_from_seconds(seconds);
    truth.robot_in_world = {1.0 + x_in_map, 2.0, 0.0};
    truth.collision_count = collisions;
    legs_.see(truth);
  }
  Legs legs_{0.5};
};

TEST_F(LegsTest, ALegIsMeasuredUpToTheFirstMomentWithinTheRadius) {
  legs_.hear_goal("a", {3.0, 0.0});
  for (int step = 1; step <= 8; ++step) see(step, 0.4 * step);
  EXPECT_TRUE(legs_.take_finished().empty());
  legs_.end();
  const auto finished = legs_.take_finished();
  ASSERT_EQ(finished.size(), 1U);
  EXPECT_TRUE(finished[0].reached);
  // 2.8 m is the first place less than 0.5 m from the goal at 3 m; 3.2 m was driven in all.
  EXPECT_NEAR(finished[0].path_length, 2.8, 1e-9);
  EXPECT_NEAR(finished[0].straight, 3.0, 1e-9);
  EXPECT_EQ(finished[0].end, time_from_seconds(7.0));
  EXPECT_TRUE(legs_.take_finished().empty());
}

TEST_F(LegsTest, AnotherGoalEndsTheLegAndTheSameOneToldAgainDoesNot) {
  legs_.hear_goal("a", {3.0, 0.0});
  see(1.0, 1.0, 2);
  legs_.hear_goal("a", {3.0, 0.0});
  see(2.0, 1.5, 2);
  legs_.hear_goal("b", {0.0, 0.0});
  const auto finished = legs_.take_finished();
  ASSERT_EQ(finished.size(), 1U);
  EXPECT_FALSE(finished[0].reached);
  EXPECT_NEAR(finished[0].path_length, 1.5, 1e-9);
  EXPECT_EQ(finished[0].collisions, 2U);
}

TEST_F(LegsTest, RowsFitTheirColumns) {
  Leg leg;
  leg.goal_in_map = {1.0, -2.0};
  leg.start = time_from_seconds(2.0);
  leg.end = time_from_seconds(5.5);
  leg.reached = true;
  const auto row = to_row(leg, 7, 3);
  ASSERT_EQ(row.size(), leg_columns().size());
  EXPECT_EQ(row[0], "7");
  EXPECT_EQ(row[1], "3");
  EXPECT_EQ(row[6], "3.50");
  EXPECT_EQ(row[9], "1");
}

}  // namespace
}  // namespace coop::referee
