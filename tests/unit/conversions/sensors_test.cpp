#include "conversions/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace coop::conversions {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinityF = std::numeric_limits<float>::infinity();
const Time kStamp(std::chrono::milliseconds(2250));

LaserScan five_beams() {
  return {.stamp = kStamp,
          .frame_id = "laser_link",
          .angle_min = -1.0F,
          .angle_increment = 0.5F,
          .time_increment = 0.01F,
          .scan_time = 0.1F,
          .range_min = 0.25F,
          .range_max = 10.0F,
          .ranges = {1.0F, 2.0F, kInfinityF, 0.0F, 5.0F}};
}

sensor_msgs::msg::Imu imu_message() {
  ImuReading reading{.stamp = kStamp, .frame_id = "imu_link"};
  reading.linear_acceleration = {0, 0, 9.81};
  reading.orientation = Eigen::Quaterniond::Identity();
  return to_msg(reading);
}

TEST(ScanConversion, the_last_beam_tells_angle_max) {
  const auto message = to_msg(five_beams());
  EXPECT_EQ(message.angle_min(), -1.0F);
  EXPECT_EQ(message.angle_max(), 1.0F);
  EXPECT_EQ(message.header().stamp().nanosec(), 250'000'000U);
  EXPECT_TRUE(message.intensities().empty());
}

TEST(ScanConversion, a_scan_survives_the_round_trip) {
  const LaserScan scan = five_beams();
  const auto back = from_msg(to_msg(scan));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, scan.stamp);
  EXPECT_EQ(back->frame_id, scan.frame_id);
  EXPECT_EQ(back->angle_min, scan.angle_min);
  EXPECT_EQ(back->angle_increment, scan.angle_increment);
  EXPECT_EQ(back->time_increment, scan.time_increment);
  EXPECT_EQ(back->scan_time, scan.scan_time);
  EXPECT_EQ(back->range_min, scan.range_min);
  EXPECT_EQ(back->range_max, scan.range_max);
  EXPECT_EQ(back->ranges, scan.ranges);
}

TEST(ScanConversion, ranges_that_are_not_numbers_are_no_returns_and_pass) {
  auto message = to_msg(five_beams());
  message.ranges()[1] = kNanF;
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->is_hit(1));
  EXPECT_TRUE(back->is_hit(0));
}

TEST(ScanConversion, every_other_number_must_be_finite) {
  for (int field = 0; field < 7; ++field) {
    for (const float bad : {kNanF, kInfinityF}) {
      auto m = to_msg(five_beams());
      float* fields[] = {&m.angle_min(), &m.angle_max(), &m.angle_increment(), &m.time_increment(),
                         &m.scan_time(), &m.range_min(), &m.range_max()};
      *fields[field] = bad;
      EXPECT_FALSE(from_msg(m)) << field;
    }
  }
}

TEST(ScanConversion, limits_that_contradict_each_other_are_refused) {
  auto message = to_msg(five_beams());
  message.range_min(11.0F);
  EXPECT_FALSE(from_msg(message));
  message.range_min(-0.1F);
  EXPECT_FALSE(from_msg(message));
}

TEST(ScanConversion, angles_must_fit_the_number_of_ranges_within_two_beams) {
  auto message = to_msg(five_beams());
  message.angle_max(1.5F);  // some drivers tell the beam behind the last
  EXPECT_TRUE(from_msg(message));
  message.angle_max(2.5F);
  EXPECT_FALSE(from_msg(message));
  message.angle_max(-1.0F);
  EXPECT_FALSE(from_msg(message));
  message.angle_max(1.0F);
  message.angle_increment(0.0F);
  EXPECT_FALSE(from_msg(message));
}

TEST(ScanConversion, a_scanner_that_turns_clockwise_is_taken) {
  auto scan = five_beams();
  scan.angle_min = 1.0F;
  scan.angle_increment = -0.5F;
  const auto message = to_msg(scan);
  EXPECT_EQ(message.angle_max(), -1.0F);
  EXPECT_TRUE(from_msg(message));
}

TEST(ScanConversion, as_many_intensities_as_ranges_or_none) {
  auto message = to_msg(five_beams());
  message.intensities(std::vector<float>(5, 1.0F));
  EXPECT_TRUE(from_msg(message));
  message.intensities(std::vector<float>(4, 1.0F));
  EXPECT_FALSE(from_msg(message));
}

TEST(ScanConversion, empty_scans_pass_and_absurdly_long_ones_do_not) {
  auto scan = five_beams();
  scan.ranges.clear();
  EXPECT_TRUE(from_msg(to_msg(scan)));
  scan.ranges.assign(kMaxScanBeams + 1, 1.0F);
  EXPECT_FALSE(from_msg(to_msg(scan)));
}

TEST(ImuConversion, a_reading_survives_the_round_trip) {
  ImuReading reading{.stamp = kStamp, .frame_id = "imu_link"};
  reading.orientation = Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
  reading.angular_velocity = {0.1, 0.2, 0.3};
  reading.linear_acceleration = {0, 0, 9.81};
  reading.orientation_covariance.diagonal() << 0.1, 0.2, 0.3;
  reading.angular_velocity_covariance.diagonal() << 0.4, 0.5, 0.6;
  reading.linear_acceleration_covariance.diagonal() << 0.7, 0.8, 0.9;
  const auto message = to_msg(reading);
  EXPECT_EQ(message.angular_velocity().z(), 0.3);
  EXPECT_EQ(message.linear_acceleration_covariance()[8], 0.9);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, kStamp);
  EXPECT_EQ(back->frame_id, "imu_link");
  EXPECT_TRUE(back->orientation->isApprox(*reading.orientation, 1e-15));
  EXPECT_EQ(back->angular_velocity, reading.angular_velocity);
  EXPECT_EQ(back->linear_acceleration, reading.linear_acceleration);
  EXPECT_EQ(back->orientation_covariance, reading.orientation_covariance);
  EXPECT_EQ(back->angular_velocity_covariance, reading.angular_velocity_covariance);
  EXPECT_EQ(back->linear_acceleration_covariance, reading.linear_acceleration_covariance);
}

TEST(ImuConversion, a_unit_without_compass_says_so_by_minus_one) {
  const auto message = to_msg(ImuReading{.stamp = kStamp, .frame_id = "imu_link"});
  EXPECT_EQ(message.orientation_covariance()[0], -1.0);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->orientation);
}

TEST(ImuConversion, an_unset_orientation_matters_only_where_it_counts) {
  auto message = imu_message();
  message.orientation().w(0.0);
  EXPECT_FALSE(from_msg(message));
  message.orientation_covariance()[0] = -1.0;
  EXPECT_TRUE(from_msg(message));
}

TEST(ImuConversion, rates_and_accelerations_must_be_measured_and_finite) {
  auto message = imu_message();
  ASSERT_TRUE(from_msg(message));
  message.angular_velocity().z(kNan);
  EXPECT_FALSE(from_msg(message));
  message = imu_message();
  message.linear_acceleration_covariance()[0] = -1.0;
  EXPECT_FALSE(from_msg(message));
  message = imu_message();
  message.angular_velocity_covariance()[4] = kNan;
  EXPECT_FALSE(from_msg(message));
}

TEST(JointStateConversion, joints_survive_the_round_trip) {
  const JointState state{kStamp, {"shoulder", "elbow"}, {0.1, 0.2}, {}, {1.0, 2.0}};
  const auto message = to_msg(state);
  EXPECT_EQ(message.name()[1], "elbow");
  EXPECT_EQ(message.position()[1], 0.2);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, kStamp);
  EXPECT_EQ(back->names, state.names);
  EXPECT_EQ(back->positions, state.positions);
  EXPECT_TRUE(back->velocities.empty());
  EXPECT_EQ(back->efforts, state.efforts);
}

TEST(JointStateConversion, lists_that_do_not_run_parallel_are_refused) {
  EXPECT_FALSE(from_msg(to_msg(JointState{kStamp, {"a", "b"}, {0.1}, {}, {}})));
  EXPECT_FALSE(from_msg(to_msg(JointState{kStamp, {"a"}, {0.1}, {0.1, 0.2}, {}})));
  EXPECT_FALSE(from_msg(to_msg(JointState{kStamp, {"a"}, {kNan}, {}, {}})));
  EXPECT_FALSE(from_msg(to_msg(JointState{kStamp, {"a", "a"}, {0.1, 0.2}, {}, {}})));
  EXPECT_FALSE(from_msg(to_msg(JointState{kStamp, {""}, {0.1}, {}, {}})));
}

TEST(CameraInfoConversion, a_calibration_survives_the_round_trip) {
  const Intrinsics camera{.width = 424, .height = 240, .fx = 308, .fy = 309, .cx = 211, .cy = 121};
  const auto message = to_msg(Stamped<Intrinsics>{kStamp, "camera_optical_frame", camera});
  EXPECT_EQ(message.k()[2], 211);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, kStamp);
  EXPECT_EQ(back->frame_id, "camera_optical_frame");
  EXPECT_EQ(back->value.width, 424);
  EXPECT_EQ(back->value.height, 240);
  EXPECT_EQ(back->value.project({0.1, -0.1, 1.0}), camera.project({0.1, -0.1, 1.0}));
}

TEST(CameraInfoConversion, what_is_no_pinhole_camera_is_refused) {
  const auto good = to_msg(Stamped<Intrinsics>{kStamp, "c", {4, 3, 5, 5, 2, 1}});
  EXPECT_TRUE(from_msg(good));
  auto message = good;
  message.width(0);
  EXPECT_FALSE(from_msg(message));
  message = good;
  message.k()[0] = 0.0;
  EXPECT_FALSE(from_msg(message));
  message = good;
  message.k()[5] = kNan;
  EXPECT_FALSE(from_msg(message));
  message = good;
  message.d()[0] = 0.1;
  EXPECT_FALSE(from_msg(message));
}

}  // namespace
}  // namespace coop::conversions
