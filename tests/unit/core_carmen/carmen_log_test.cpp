#include "core/carmen/carmen_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>
#include <system_error>

#include "core/random.hpp"
#include "support/shared_data.hpp"

namespace coop::carmen {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

LogReader reader_of(const std::string& text) {
  return {std::make_unique<std::istringstream>(text), "test.clf"};
}

std::vector<Record> read(const std::string& text, ReadReport* report = nullptr) {
  LogReader reader = reader_of(text);
  std::vector<Record> records;
  while (auto record = reader.next()) records.push_back(*record);
  if (report != nullptr) *report = reader.report();
  return records;
}

constexpr const char* kOdometry = "ODOM 1.5 -2 0.25 0.4 -0.1 0.05 976052890.445500 myhost 0.2\n";
constexpr const char* kLaser =
    "FLASER 3 1.00 2.50 81.83 0.1 0.2 0.3 1 2 3 976052890.244111 nohost 0.1\n";

TEST(CarmenLog, ReadsOdometry) {
  const auto records = read(kOdometry);
  ASSERT_EQ(records.size(), 1U);
  const auto& odometry = std::get<OdometryRecord>(records[0]);
  EXPECT_EQ(odometry.robot_in_odom, (Pose2{1.5, -2.0, 0.25}));
  EXPECT_EQ(odometry.v, 0.4);
  EXPECT_EQ(odometry.omega, -0.1);
  EXPECT_EQ(odometry.acceleration, 0.05);
  EXPECT_EQ(to_nanoseconds(odometry.stamp), 976052890445500000) << "the first stamp, exactly";
}

TEST(CarmenLog, ReadsTheOlderLaserMessageWithItsTwoPoses) {
  const auto records = read(kLaser);
  const auto& laser = std::get<LaserRecord>(records.at(0));
  EXPECT_FALSE(laser.rear);
  EXPECT_EQ(laser.ranges, (std::vector<float>{1.0F, 2.5F, 81.83F}));
  EXPECT_EQ(laser.laser_in_odom, (Pose2{0.1, 0.2, 0.3}));
  EXPECT_EQ(laser.robot_in_odom, (Pose2{1, 2, 3}));
  EXPECT_EQ(to_nanoseconds(laser.stamp), 976052890244111000);
  EXPECT_TRUE(std::get<LaserRecord>(read("RLASER 1 2 0 0 0 0 0 0 5.0 h 5\n").at(0)).rear);
}

TEST(CarmenLog, OlderLaserMessagesTakeTheirGeometryFromTheNumberOfReadings) {
  const auto geometry = [](int readings) {
    std::string line = "FLASER " + std::to_string(readings);
    for (int i = 0; i < readings; ++i) line += " 1.0";
    return std::get<LaserRecord>(read(line + " 0 0 0 0 0 0 1.0 h 1.0\n").at(0));
  };
  constexpr double kDegree = std::numbers::pi / 180;
  for (const int readings : {180, 181}) {
    EXPECT_NEAR(geometry(readings).angle_increment, kDegree, 1e-12);
    EXPECT_NEAR(geometry(readings).angle_min, -90 * kDegree, 1e-12);
  }
  EXPECT_NEAR(geometry(361).angle_increment, 0.5 * kDegree, 1e-12);
  EXPECT_NEAR(geometry(401).angle_min, -50 * kDegree, 1e-12);
  EXPECT_NEAR(geometry(90).angle_increment, 2 * kDegree, 1e-12);
}

TEST(CarmenLog, ReadsTheNewerLaserMessage) {
  const auto records = read(
      "ROBOTLASER1 0 -1.57 3.14 0.0175 50.0 0.01 1 2 4.0 5.0 2 0.5 0.75 1 2 3 4 5 6 "
      "0.1 0.2 0.3 0.4 1e10 7.25 host 1.0\n");
  const auto& laser = std::get<LaserRecord>(records.at(0));
  EXPECT_EQ(laser.angle_min, -1.57);
  EXPECT_EQ(laser.angle_increment, 0.0175);
  EXPECT_EQ(laser.range_max, 50.0);
  EXPECT_EQ(laser.ranges, (std::vector<float>{4.0F, 5.0F}));
  EXPECT_EQ(laser.remissions, (std::vector<float>{0.5F, 0.75F}));
  EXPECT_EQ(laser.laser_in_odom, (Pose2{1, 2, 3}));
  EXPECT_EQ(laser.robot_in_odom, (Pose2{4, 5, 6}));
  EXPECT_EQ(laser.stamp, time_from_seconds(7.25));
}

TEST(CarmenLog, ParameterOfTheLasersRangeHoldsForTheMessagesAfterIt) {
  const auto records =
      read(std::string(kLaser) + "PARAM robot_front_laser_max 2.0 nohost 0\n" + kLaser);
  EXPECT_EQ(std::get<LaserRecord>(records[0]).range_max, 80.0);
  EXPECT_EQ(std::get<ParameterRecord>(records[1]),
            (ParameterRecord{"robot_front_laser_max", "2.0"}));
  EXPECT_EQ(std::get<LaserRecord>(records[2]).range_max, 2.0);
}

TEST(CarmenLog, SkipsCommentsEmptyLinesAndMessagesItHasNoUseFor) {
  ReadReport report;
  const auto records =
      read(std::string("# a comment\n\nNEFF 20.9\nTRUEPOS 1 2 3\r\n") + kOdometry, &report);
  EXPECT_EQ(records.size(), 1U);
  EXPECT_EQ(report.lines, 5U);
  EXPECT_EQ(report.records, 1U);
  EXPECT_EQ(report.other_messages, 2U);
}

TEST(CarmenLog, EmptyLogHoldsNothing) {
  EXPECT_TRUE(read("").empty());
}

struct BadLine {
  const char* name;
  const char* line;
  const char* message;
};

class MalformedLine : public testing::TestWithParam<BadLine> {};

TEST_P(MalformedLine, IsRefusedWithItsNumberAndWhatWasExpected) {
  const std::string text =
      std::string("# first\n") + kOdometry + GetParam().line + "\n" + kOdometry;
  EXPECT_THAT(
      [&] { (void)read(text); },
      ThrowsMessage<FormatError>(HasSubstr("test.clf:3: " + std::string(GetParam().message))));
}

INSTANTIATE_TEST_SUITE_P(
    CarmenLog, MalformedLine,
    testing::Values(
        BadLine{"odometry_too_short", "ODOM 1 2 3 4 5", "expected accel, the line ends"},
        BadLine{"odometry_not_a_number", "ODOM 1 two 3 0 0 0 1.0 h 1.0",
                "expected y of the pose of the robot, a number, found 'two'"},
        BadLine{"odometry_infinite", "ODOM 1 inf 3 0 0 0 1.0 h 1.0",
                "expected y of the pose of the robot, a number, found 'inf'"},
        BadLine{"stamp", "ODOM 1 2 3 0 0 0 noon h 1.0",
                "expected the stamp in seconds, found 'noon'"},
        BadLine{"stamp_too_large", "ODOM 1 2 3 0 0 0 1e300 h 1.0",
                "expected the stamp in seconds, found '1e300'"},
        BadLine{"no_host", "ODOM 1 2 3 0 0 0 1.0", "expected the host name, the line ends"},
        BadLine{"readings_missing", "FLASER 5 1.0 2.0", "expected readings, the line ends"},
        BadLine{"readings_not_numbers", "FLASER 2 1.0 x 0 0 0 0 0 0 1.0 h 1.0",
                "expected readings, a number, found 'x'"},
        BadLine{"count_negative", "FLASER -2 1.0", "expected the number of readings, found '-2'"},
        BadLine{"count_absurd", "FLASER 4000000000 1.0",
                "expected the number of readings, found '4000000000'"},
        BadLine{"laser_range_of_a_parameter", "PARAM robot_front_laser_max far",
                "expected a positive number of metres"},
        BadLine{"parameter_without_value", "PARAM robot_length",
                "expected the parameter's value, the line ends"},
        BadLine{"no_message", "\x1f\x8b\x08 binary", "expected a CARMEN message"}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(CarmenLog, LastLineThatEndsTooEarlyIsLeftOutAndReported) {
  ReadReport report;
  const std::string text = std::string(kOdometry) + kLaser;
  for (std::size_t cut = 1; cut < 60; ++cut) {
    const auto records = read(text.substr(0, text.size() - cut), &report);
    if (records.size() == 2) {
      EXPECT_EQ(std::get<LaserRecord>(records[1]), std::get<LaserRecord>(read(kLaser)[0])) << cut;
      EXPECT_EQ(report.truncated_line, 0U);
    } else {
      EXPECT_EQ(records.size(), 1U);
      EXPECT_EQ(report.truncated_line, 2U) << cut;
    }
  }
}

TEST(CarmenLog, StampsThatRunBackwardsAreDeliveredAndCounted) {
  ReadReport report;
  const auto records = read(
      "ODOM 1 0 0 0 0 0 10.0 h 0\nODOM 2 0 0 0 0 0 9.5 h 0\nODOM 3 0 0 0 0 0 9.8 h 0\nODOM 4 0 0 0 "
      "0 0 11.0 h 0\n",
      &report);
  EXPECT_EQ(records.size(), 4U);
  EXPECT_EQ(report.backward_stamps, 2U);
  EXPECT_EQ(std::get<OdometryRecord>(records[1]).stamp, time_from_seconds(9.5));
}

TEST(CarmenLog, SortingOrdersByStampAndKeepsTheOrderOfEqualOnes) {
  auto records = read(
      "ODOM 1 0 0 0 0 0 10.0 h 0\nPARAM a 1\nODOM 2 0 0 0 0 0 9.5 h 0\nODOM 3 0 0 0 0 0 10.0 h 0\n"
      "ODOM 4 0 0 0 0 0 9.5 h 0\n");
  EXPECT_EQ(sort_by_stamp(records), 0U);
  EXPECT_TRUE(std::holds_alternative<ParameterRecord>(records[0]));
  std::vector<double> order;
  for (std::size_t i = 1; i < records.size(); ++i)
    order.push_back(std::get<OdometryRecord>(records[i]).robot_in_odom.x);
  EXPECT_THAT(order, testing::ElementsAre(2, 4, 1, 3));
}

TEST(CarmenLog, SortingKeepsARecordWithANonsenseStampInItsPlace) {
  auto records = read(
      "ODOM 1 0 0 0 0 0 100.0 h 0\nODOM 2 0 0 0 0 0 2.48584e-91 h 0\nODOM 3 0 0 0 0 0 -1.7 h 0\n"
      "ODOM 4 0 0 0 0 0 1.001e+02 h 0\n");
  EXPECT_EQ(sort_by_stamp(records), 2U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(std::get<OdometryRecord>(records[i]).robot_in_odom.x, static_cast<double>(i + 1));
  EXPECT_EQ(stamp_of(records[1]), time_from_seconds(100.0));
  EXPECT_EQ(stamp_of(records[3]), time_from_seconds(100.1));
}

TEST(CarmenLog, WhatIsWrittenIsReadBack) {
  const auto records = read(std::string(kOdometry) +
                            "PARAM robot_length 0.47\nROBOTLASER2 0 -1.5 3.0 0.5 50 0.01 0 3 1 2 3 "
                            "0 1 2 3 4 5 6 0 0 0 0 0 7.25 h 0\n");
  std::string text;
  for (const Record& record : records) text += to_line(record);
  EXPECT_EQ(read(text), records);
}

TEST(CarmenLog, ScanOfARecordCallsReadingsBeyondTheRangeMisses) {
  const auto laser = std::get<LaserRecord>(read(kLaser).at(0));
  const LaserScan scan = to_scan(laser, "laser_link");
  EXPECT_EQ(scan.frame_id, "laser_link");
  EXPECT_EQ(scan.stamp, laser.stamp);
  EXPECT_TRUE(scan.is_hit(0));
  EXPECT_TRUE(std::isinf(scan.ranges[2]));
  EXPECT_EQ(to_odometry(laser).base_in_odom, (Pose2{1, 2, 3}));
}

TEST(CarmenLog, AReadingOfZeroIsNoMeasurement) {
  LaserRecord laser;
  laser.range_max = 80.0;
  laser.ranges = {0.0F, 2.0F};
  const LaserScan scan = to_scan(laser, "laser_link");
  EXPECT_TRUE(std::isnan(scan.ranges[0]));
  EXPECT_FALSE(scan.is_hit(0));
  EXPECT_TRUE(scan.is_hit(1));
}

TEST(CarmenLog, MissingFileIsASystemError) {
  EXPECT_THROW(LogReader(std::filesystem::path("/nowhere/at/all.clf")), std::system_error);
  EXPECT_THROW(LogReader(std::filesystem::path("/tmp")), std::system_error);
}

TEST(CarmenLog, DamagedLinesEitherReadOrAreRefusedNeverMore) {
  RandomStream random(1, "damaged lines");
  const std::string text = std::string(kOdometry) + kLaser + "PARAM a b\n";
  for (int trial = 0; trial < 5000; ++trial) {
    std::string damaged = text;
    for (int i = 0; i < 3; ++i)
      damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    try {
      for (const auto& record : read(damaged)) {
        const auto* laser = std::get_if<LaserRecord>(&record);
        ASSERT_TRUE(laser == nullptr || is_finite(laser->robot_in_odom));
      }
    } catch (const FormatError& error) {
      ASSERT_THAT(error.what(), HasSubstr("test.clf:"));
    }
  }
}

TEST(CarmenLog, IntelLabLogReadsAsItsDescriptionSays) {
  const auto path = test::shared_data("slam/intel.clf");
  if (!path) GTEST_SKIP() << "not run: the shared data set is absent";
  ReadReport report;
  const auto records = read_log(*path, &report);
  std::size_t scans = 0;
  for (const Record& record : records) {
    if (const auto* laser = std::get_if<LaserRecord>(&record)) {
      ++scans;
      ASSERT_EQ(laser->ranges.size(), 180U);
    }
  }
  EXPECT_EQ(scans, 910U);
  EXPECT_EQ(records.size(), 12069U);
  EXPECT_EQ(report.truncated_line, 0U);
}

}  // namespace
}  // namespace coop::carmen
