#include "core/scan_queue.hpp"

#include <gtest/gtest.h>

#include "unit/core/at.hpp"

namespace coop {
namespace {

using test::at;

class ScanQueueTest : public testing::Test {
 protected:
  ScanQueueTest() { transforms_.insert_static("base_link", "laser_link", to_pose3({0.6, 0, 0})); }

  /// Takes 0.1 s from the first of its three beams to the last.
  static LaserScan scan_at(double seconds) {
    LaserScan scan;
    scan.stamp = at(seconds);
    scan.frame_id = "laser_link";
    scan.time_increment = 0.05F;
    scan.ranges = {1.0F, 1.0F, 1.0F};
    return scan;
  }

  ScanQueue queue_{{.patience = std::chrono::seconds(1), .limit = 3}};
  OdometryTrack odometry_;
  TransformBuffer transforms_;
};

TEST_F(ScanQueueTest, AScanWaitsForTheOdometryAtItsLastBeam) {
  odometry_.insert({at(0.9), {0.0, 0, 0}});
  odometry_.insert({at(1.05), {0.3, 0, 0}});
  queue_.push(scan_at(1.0));
  EXPECT_FALSE(queue_.next(odometry_, transforms_, at(1.1)));
  odometry_.insert({at(1.15), {0.5, 0, 0}});
  const auto located = queue_.next(odometry_, transforms_, at(1.2));
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->base_in_track.base_in_odom.x, 0.2, 1e-6);
  EXPECT_NEAR(located->sweep.x, 0.2, 1e-6);  // 0.4 at the last beam
  EXPECT_NEAR(located->laser_in_base.x, 0.6, 1e-12);
  EXPECT_TRUE(queue_.empty());
  EXPECT_EQ(queue_.dropped(), 0U);
}

TEST_F(ScanQueueTest, WhoDoesNotAskForTheSweepDoesNotWaitForIt) {
  ScanQueue queue({.whole_sweep = false});
  odometry_.insert({at(1.0), {0.2, 0, 0}});
  queue.push(scan_at(1.0));
  const auto located = queue.next(odometry_, transforms_, at(1.0));
  ASSERT_TRUE(located);
  EXPECT_EQ(located->sweep, Pose2{});
}

TEST_F(ScanQueueTest, GivesUpAScanWhoseOdometryDoesNotCome) {
  queue_.push(scan_at(1.0));
  EXPECT_FALSE(queue_.next(odometry_, transforms_, at(1.9)));
  EXPECT_EQ(queue_.size(), 1U);
  EXPECT_FALSE(queue_.next(odometry_, transforms_, at(2.1)));
  EXPECT_TRUE(queue_.empty());
  EXPECT_EQ(queue_.dropped(), 1U);
  EXPECT_EQ(queue_.lack(), "odometry at their stamp");
}

TEST_F(ScanQueueTest, GivesUpAScanOfALaserThatNobodyMounted) {
  odometry_.insert({at(0.5), {}});
  odometry_.insert({at(1.5), {}});
  LaserScan scan = scan_at(1.0);
  scan.frame_id = "rear_laser";
  queue_.push(scan);
  EXPECT_FALSE(queue_.next(odometry_, transforms_, at(2.1)));
  EXPECT_EQ(queue_.lack(), "mount of rear_laser");
}

TEST_F(ScanQueueTest, DropsScansTakenWhileOdometryWasAwayAndGoesOnWithTheNext) {
  odometry_.insert({at(0.95), {7, 0, 0}}, "one");
  odometry_.insert({at(1.0), {7, 0, 0}}, "one");
  odometry_.insert({at(2.0), {0, 0, 0}}, "two");
  odometry_.insert({at(3.0), {0, 0, 0}}, "two");
  queue_.push(scan_at(0.95));  // begins before, ends within the gap
  queue_.push(scan_at(1.5));
  queue_.push(scan_at(2.1));
  const auto located = queue_.next(odometry_, transforms_, at(2.3));
  ASSERT_TRUE(located);
  EXPECT_EQ(located->scan.stamp, at(2.1));
  EXPECT_EQ(located->base_in_track.piece, 1U);
  EXPECT_EQ(queue_.dropped(), 2U);
}

TEST_F(ScanQueueTest, WhereTooManyWaitTheOldestMakesRoom) {
  for (int i = 0; i < 5; ++i) queue_.push(scan_at(1.0 + 0.1 * i));
  EXPECT_EQ(queue_.size(), 3U);
  EXPECT_EQ(queue_.dropped(), 2U);
  EXPECT_EQ(queue_.front().stamp, at(1.2));
}

}  // namespace
}  // namespace coop
