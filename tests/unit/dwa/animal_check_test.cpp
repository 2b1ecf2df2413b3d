#include "dwa/animal_check.hpp"

#include <gtest/gtest.h>

#include "unit/dwa/test_base.hpp"

namespace coop::dwa {
namespace {

constexpr double kStep = 0.1;  // s

Detection pig(double x, double y) {
  Detection detection;
  detection.position = {x, y, 0.2};
  detection.size = {0.4, 0.4, 0.4};
  return detection;
}

/// Straight on along x at that speed, m/s, for two seconds.
Trajectory straight(double speed) {
  Trajectory trajectory;
  for (int i = 1; i <= 20; ++i) trajectory.push_back({speed * kStep * i, 0.0, 0.0});
  return trajectory;
}

class AnimalCheckTest : public ::testing::Test {
 protected:
  /// A pig that has walked for two seconds at `velocity` and is at `place` when the robot, at the
  /// origin of odom, looks ahead.
  void let_walk(const Eigen::Vector2d& place, const Eigen::Vector2d& velocity) {
    check_ = AnimalCheck(config_, Footprint(test::kBaseFootprint), kStep);
    for (int i = -20; i <= 0; ++i) {
      const Eigen::Vector2d at = place + 0.1 * i * velocity;
      EXPECT_TRUE(check_.see({pig(at.x(), at.y())}, time_from_seconds(10.0 + 0.1 * i)));
    }
  }
  bool collides(const Trajectory& trajectory, double now = 10.0, const Pose2& odom_in_map = {}) {
    check_.place({}, odom_in_map, time_from_seconds(now));
    return check_.collides(trajectory);
  }

  AnimalCheckConfig config_;
  AnimalCheck check_{config_, Footprint(test::kBaseFootprint), kStep};
};

TEST_F(AnimalCheckTest, WithoutAnimalsEveryTrajectoryIsFree) {
  EXPECT_FALSE(collides(straight(0.5)));
}

TEST_F(AnimalCheckTest, AnAnimalThatWalksAcrossIsMetWhereItWillBeNotWhereItIs) {
  let_walk({1.5, -1.0}, {0.0, 0.5});      // at (1.5, -0.5) in a second
  EXPECT_TRUE(collides(straight(0.6)));   // the nose at 1.37 m, the pig's edge at -0.2 m
  EXPECT_FALSE(collides(straight(0.1)));  // the nose at 0.87 m: it passes
}

TEST_F(AnimalCheckTest, AnAnimalThatWalksAwayIsNoObstacle) {
  let_walk({1.2, 0.0}, {0.6, 0.0});
  EXPECT_FALSE(collides(straight(0.5)));
  let_walk({1.2, 0.0}, {0.0, 0.0});
  EXPECT_TRUE(collides(straight(0.5)));
}

TEST_F(AnimalCheckTest, BeyondTheHorizonNothingIsForetold) {
  let_walk({2.1, 0.0}, {0.0, 0.0});
  EXPECT_FALSE(collides(straight(0.6)));  // met after 1.5 s
  config_.horizon = 2.0;
  let_walk({2.1, 0.0}, {0.0, 0.0});
  EXPECT_TRUE(collides(straight(0.6)));
}

TEST_F(AnimalCheckTest, AnAnimalNotSeenForLongIsForgotten) {
  let_walk({1.2, 0.0}, {0.0, 0.0});
  EXPECT_TRUE(collides(straight(0.5), 10.9));
  EXPECT_FALSE(collides(straight(0.5), 11.1));
}

TEST_F(AnimalCheckTest, AnAnimalThatIsTouchedMayBeLeftButNotPushed) {
  let_walk({0.9, 0.0}, {0.0, 0.0});  // its edge 7 cm behind the nose
  EXPECT_TRUE(collides(straight(0.3)));
  EXPECT_FALSE(collides(straight(-0.3)));
}

TEST_F(AnimalCheckTest, AnimalsAreSeenFromOdom) {
  let_walk({11.2, 5.0}, {0.0, 0.0});
  EXPECT_FALSE(collides(straight(0.5)));
  EXPECT_TRUE(collides(straight(0.5), 10.0, {10.0, 5.0, 0.0}));
}

}  // namespace
}  // namespace coop::dwa
