#include "chassis_driver/odometry_log.hpp"

#include <gtest/gtest.h>

#include "support/shared_data.hpp"

namespace coop::chassis_driver {
namespace {

carmen::Record odometry(double stamp, double x) {
  return carmen::OdometryRecord{.stamp = time_from_seconds(stamp), .robot_in_odom = {x, 0, 0}};
}

carmen::Record laser(double stamp, double x) {
  carmen::LaserRecord record;
  record.stamp = time_from_seconds(stamp);
  record.robot_in_odom = {x, 0, 0};
  record.laser_in_odom = {-1, -1, 0};
  return record;
}

TEST(OdometryLog, TakesTheOdometryOfOdometryAndLaserLines) {
  const OdometryLog log({odometry(1, 0.1), laser(2, 0.2), odometry(3, 0.3)});
  ASSERT_EQ(log.size(), 3U);
  EXPECT_EQ(log[1].base_in_odom.x, 0.2);
  EXPECT_EQ(log.begin(), time_from_seconds(1));
  EXPECT_EQ(log.end(), time_from_seconds(3));
}

TEST(OdometryLog, PutsReadingsInOrderOfTheirStamps) {
  const OdometryLog log({odometry(1, 0.1), odometry(3, 0.3), odometry(2, 0.2)});
  EXPECT_EQ(log[1].base_in_odom.x, 0.2);
  EXPECT_EQ(log[2].base_in_odom.x, 0.3);
}

TEST(OdometryLog, OfReadingsWithOneStampTheLastStands) {
  const OdometryLog log({odometry(1, 0.1), odometry(2, 0.2), laser(2, 0.25), odometry(3, 0.3)});
  ASSERT_EQ(log.size(), 3U);
  EXPECT_EQ(log[1].base_in_odom.x, 0.25);
}

TEST(OdometryLog, RefusesALogWithoutOdometry) {
  EXPECT_THROW(OdometryLog({carmen::ParameterRecord{"a", "b"}}), std::runtime_error);
}

TEST(OdometryLog, HoldsThePoseOfEveryScanOfTheIntelLog) {
  const auto path = coop::test::shared_data("slam/intel.clf");
  if (!path) GTEST_SKIP() << "not run: the Intel log is not there";
  const auto records = carmen::read_log(*path);
  const OdometryLog log(records);
  std::size_t at = 0;
  int scans = 0;
  for (const carmen::Record& record : records) {
    const auto* scan = std::get_if<carmen::LaserRecord>(&record);
    if (scan == nullptr) continue;
    ++scans;
    while (at < log.size() && log[at].stamp < scan->stamp) ++at;
    ASSERT_LT(at, log.size());
    EXPECT_EQ(log[at].stamp, scan->stamp);
    EXPECT_EQ(log[at].base_in_odom, scan->robot_in_odom);
  }
  EXPECT_EQ(scans, 910);
}

}  // namespace
}  // namespace coop::chassis_driver
