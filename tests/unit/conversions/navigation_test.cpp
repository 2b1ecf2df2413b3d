#include "conversions/navigation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "conversions/geometry.hpp"

namespace coop::conversions {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Time kStamp(std::chrono::seconds(7));

/// 3 x 2 cells of 5 cm:  row 1:  -1 50 100
///                       row 0:   0  1   2
Stamped<OccupancyGrid> small_grid() {
  Stamped<OccupancyGrid> grid{kStamp, "map", {}};
  grid.value.geometry = {3, 2, 0.05, {-1.5, 2.25}};
  grid.value.cells = {0, 1, 2, -1, 50, 100};
  return grid;
}

TEST(OdometryConversion, pose_in_odom_and_velocity_in_base_link_survive_the_round_trip) {
  FramedOdometry odometry;
  odometry.odometry = {kStamp, {1, 2, 0}, {0.4, 0.1}};
  odometry.covariance(2, 2) = 0.01;
  const auto message = to_msg(odometry);
  EXPECT_EQ(message.header().frame_id(), "odom");
  EXPECT_EQ(message.child_frame_id(), "base_link");
  EXPECT_EQ(message.pose().pose().position().y(), 2.0);
  EXPECT_EQ(message.pose().covariance()[35], 0.01);
  EXPECT_EQ(message.twist().twist().linear().x(), 0.4);
  EXPECT_EQ(message.twist().twist().angular().z(), 0.1);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->odometry.stamp, kStamp);
  EXPECT_EQ(back->odometry.base_in_odom, (Pose2{1, 2, 0}));
  EXPECT_EQ(back->odometry.velocity, (Twist2{0.4, 0.1}));
  EXPECT_EQ(back->covariance, odometry.covariance);
  EXPECT_EQ(back->child_frame_id, "base_link");
}

TEST(OdometryConversion, each_part_that_is_bad_makes_it_bad) {
  const auto good = to_msg(FramedOdometry{});
  ASSERT_TRUE(from_msg(good));
  auto message = good;
  message.pose().pose().orientation().w(0.0);
  EXPECT_FALSE(from_msg(message));
  message = good;
  message.twist().twist().angular().z(kNan);
  EXPECT_FALSE(from_msg(message));
  message = good;
  message.pose().covariance()[0] = -1.0;
  EXPECT_FALSE(from_msg(message));
  message = good;
  message.header().stamp().nanosec(1'000'000'000);
  EXPECT_FALSE(from_msg(message));
}

TEST(GridConversion, cells_are_written_row_by_row_from_the_origin) {
  const auto message = to_msg(small_grid());
  EXPECT_EQ(message.info().width(), 3U);
  EXPECT_EQ(message.info().height(), 2U);
  EXPECT_EQ(message.info().resolution(), 0.05F);
  EXPECT_EQ(message.info().origin().position().x(), -1.5);
  EXPECT_EQ(message.info().origin().orientation().w(), 1.0);
  EXPECT_EQ(message.data(), (std::vector<std::int8_t>{0, 1, 2, -1, 50, 100}));
}

TEST(GridConversion, the_grid_that_comes_back_is_the_same_to_the_bit) {
  for (const double resolution : {0.05, 0.1, 0.025, 0.03, 1.0, 0.2}) {
    auto grid = small_grid();
    grid.value.geometry.resolution = resolution;
    const auto back = from_msg(to_msg(grid));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->value, grid.value) << resolution;
    EXPECT_EQ(back->stamp, kStamp);
    EXPECT_EQ(back->frame_id, "map");
  }
}

TEST(GridConversion, a_number_of_cells_that_does_not_fit_the_size_is_refused) {
  auto message = to_msg(small_grid());
  message.data().pop_back();
  const auto result = from_msg(message);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error(), "a grid of 3 x 2 with 5 cells");
  message.data({});
  EXPECT_FALSE(from_msg(message));
}

TEST(GridConversion, sizes_that_are_absurd_or_overflow_are_refused) {
  auto message = to_msg(small_grid());
  for (const auto& [width, height] : {std::pair{0U, 0U},
                                      {3U, 0U},
                                      {0xffffffffU, 0xffffffffU},
                                      {0x10000U, 0x10000U},
                                      {0xffffffffU, 1U},
                                      {0x80000000U, 2U}}) {
    message.info().width(width);
    message.info().height(height);
    EXPECT_FALSE(from_msg(message)) << width << " x " << height;
  }
}

TEST(GridConversion, resolutions_that_are_no_length_are_refused) {
  for (const float resolution : {0.0F, -0.05F, std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::infinity()}) {
    auto message = to_msg(small_grid());
    message.info().resolution(resolution);
    EXPECT_FALSE(from_msg(message)) << resolution;
  }
}

TEST(GridConversion, a_rotated_or_unset_origin_is_refused) {
  auto message = to_msg(small_grid());
  message.info().origin(to_msg(Pose2{0, 0, 0.1}));
  EXPECT_FALSE(from_msg(message));
  message.info().origin().orientation().z(0.0);
  message.info().origin().orientation().w(0.0);
  EXPECT_FALSE(from_msg(message));
}

TEST(GridConversion, values_that_are_no_occupancy_are_refused) {
  for (const std::int8_t value : {std::int8_t{-2}, std::int8_t{101}, std::int8_t{-128}}) {
    auto message = to_msg(small_grid());
    message.data()[4] = value;
    EXPECT_FALSE(from_msg(message)) << int{value};
  }
}

TEST(PathConversion, every_pose_has_the_stamp_and_frame_of_the_path) {
  const auto message = to_path_msg({kStamp, "map", {Pose2{0, 0, 0}, Pose2{1, 0, 0}}});
  ASSERT_EQ(message.poses().size(), 2U);
  EXPECT_EQ(message.poses()[1].header().frame_id(), "map");
  EXPECT_EQ(message.poses()[1].header().stamp().sec(), 7);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->value, (std::vector<Pose2>{{0, 0, 0}, {1, 0, 0}}));
}

TEST(PathConversion, an_empty_path_is_a_path) {
  const auto back = from_msg(to_path_msg({kStamp, "map", {}}));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->value.empty());
}

TEST(PathConversion, poses_in_other_frames_are_refused_and_unnamed_ones_taken) {
  auto message = to_path_msg({kStamp, "map", {Pose2{0, 0, 0}, Pose2{1, 0, 0}}});
  message.poses()[1].header().frame_id("");
  EXPECT_TRUE(from_msg(message));
  message.poses()[1].header().frame_id("odom");
  EXPECT_FALSE(from_msg(message));
}

TEST(PathConversion, one_bad_pose_makes_the_path_bad) {
  auto message = to_path_msg({kStamp, "map", {Pose2{0, 0, 0}, Pose2{1, 0, 0}}});
  message.poses()[0].pose().position().x(kNan);
  EXPECT_FALSE(from_msg(message));
}

}  // namespace
}  // namespace coop::conversions
