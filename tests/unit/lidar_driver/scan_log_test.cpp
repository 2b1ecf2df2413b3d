#include "lidar_driver/scan_log.hpp"

#include <gtest/gtest.h>

namespace coop::lidar_driver {
namespace {

carmen::Record laser(double stamp, float range, bool rear = false) {
  carmen::LaserRecord record;
  record.stamp = time_from_seconds(stamp);
  record.rear = rear;
  record.angle_min = -1.5;
  record.angle_increment = 0.1;
  record.range_max = 80.0;
  record.ranges = {range, 2.0F};
  return record;
}

carmen::Record odometry(double stamp) {
  return carmen::OdometryRecord{.stamp = time_from_seconds(stamp), .robot_in_odom = {}};
}

Time at(double s) {
  return time_from_seconds(s);
}

TEST(ScanLog, HandsOutScansAsTimeComesToThem) {
  ScanLog log({odometry(1), laser(2, 1.0F), laser(3, 3.0F)}, {}, "laser_link");
  EXPECT_EQ(log.next(at(1.999)), nullptr);
  ASSERT_NE(log.next(at(2)), nullptr);
  EXPECT_EQ(log.next(at(9))->stamp, at(2));  // until it is taken
  EXPECT_EQ(log.next(at(2))->frame_id, "laser_link");
  log.pop();
  EXPECT_EQ(log.next(at(2.9)), nullptr);
  EXPECT_EQ(log.next(at(3))->ranges.front(), 3.0F);
  log.pop();
  EXPECT_TRUE(log.at_end());
  EXPECT_EQ(log.next(at(99)), nullptr);
}

TEST(ScanLog, PutsScansInOrderAndLeavesOutTheRearLaser) {
  ScanLog log({laser(3, 3.0F), laser(2, 1.0F), laser(2.5, 9.0F, true)}, {}, "laser_link");
  EXPECT_EQ(log.size(), 2U);
  EXPECT_EQ(log.next(at(9))->stamp, at(2));
}

TEST(ScanLog, ASectionCountsFromTheFirstRecordOfTheLog) {
  const std::vector<carmen::Record> records = {odometry(10), laser(11, 1.0F), laser(12, 1.0F),
                                               laser(13, 1.0F), laser(14, 1.0F)};
  ScanLog log(records, {.start = 2.0, .duration = 1.5}, "laser_link");
  EXPECT_EQ(log.size(), 2U);
  EXPECT_EQ(log.next(at(99))->stamp, at(12));
}

TEST(ScanLog, RefusesALogWithoutScans) {
  EXPECT_THROW(ScanLog({odometry(1)}, {}, "laser_link"), std::runtime_error);
}

}  // namespace
}  // namespace coop::lidar_driver
