#include "conversions/geometry.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace coop::conversions {
namespace {

using std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Time kStamp(std::chrono::milliseconds(1500));

TEST(GeometryConversion, a_quarter_turn_is_the_quaternion_of_half_the_angle) {
  const auto message = to_msg(Pose2{1.0, -2.0, pi / 2});
  EXPECT_EQ(message.position().x(), 1.0);
  EXPECT_EQ(message.position().y(), -2.0);
  EXPECT_EQ(message.position().z(), 0.0);
  EXPECT_EQ(message.orientation().x(), 0.0);
  EXPECT_EQ(message.orientation().y(), 0.0);
  EXPECT_NEAR(message.orientation().z(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(message.orientation().w(), std::sqrt(0.5), 1e-15);
}

TEST(GeometryConversion, planar_poses_of_all_headings_survive_the_round_trip) {
  for (double yaw = -pi; yaw < pi; yaw += 0.1) {
    const auto back = pose2_from_msg(to_msg(Pose2{3.0, 4.0, yaw}));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->position(), Eigen::Vector2d(3.0, 4.0));
    EXPECT_NEAR(angle_difference(back->yaw, yaw), 0.0, 1e-15);
  }
}

TEST(GeometryConversion, a_quaternion_and_its_negative_are_one_heading) {
  auto message = to_msg(Pose2{0, 0, 1.0});
  message.orientation().z(-message.orientation().z());
  message.orientation().w(-message.orientation().w());
  EXPECT_NEAR(pose2_from_msg(message)->yaw, 1.0, 1e-15);
}

TEST(GeometryConversion, a_spatial_pose_survives_the_round_trip) {
  Pose3 pose = Pose3::Identity();
  pose.translation() << 1.0, 2.0, 3.0;
  pose.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto back = pose3_from_msg(to_msg(pose));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->isApprox(pose, 1e-14));
}

TEST(GeometryConversion, a_pose_put_on_the_floor_keeps_the_heading_of_its_x_axis) {
  Pose3 pose = Pose3::Identity();
  pose.translation() << 1.0, 2.0, 3.0;
  pose.linear() = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()))
                      .toRotationMatrix();
  const auto flat = pose2_from_msg(to_msg(pose));
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->position(), Eigen::Vector2d(1.0, 2.0));
  EXPECT_NEAR(flat->yaw, 0.5, 1e-14);
}

TEST(GeometryConversion, the_zero_quaternion_is_refused) {
  geometry_msgs::msg::Pose message;
  message.orientation().w(0.0);
  EXPECT_FALSE(pose2_from_msg(message));
  EXPECT_FALSE(pose3_from_msg(message));
}

TEST(GeometryConversion, a_slightly_long_quaternion_is_normalised_and_a_long_one_refused) {
  geometry_msgs::msg::Quaternion message;
  message.w(1.009);
  ASSERT_TRUE(from_msg(message));
  EXPECT_EQ(from_msg(message)->w(), 1.0);
  message.w(1.02);
  EXPECT_FALSE(from_msg(message));
}

TEST(GeometryConversion, numbers_that_are_not_finite_are_refused_wherever_they_stand) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int field = 0; field < 7; ++field) {
      auto message = to_msg(Pose2{1, 2, 0.5});
      auto& p = message.position();
      auto& q = message.orientation();
      double* fields[] = {&p.x(), &p.y(), &p.z(), &q.x(), &q.y(), &q.z(), &q.w()};
      *fields[field] = bad;
      EXPECT_FALSE(pose2_from_msg(message)) << field;
      EXPECT_FALSE(pose3_from_msg(message)) << field;
    }
  }
}

TEST(GeometryConversion, a_stamped_pose_keeps_time_and_frame) {
  const auto message = to_msg(Stamped<Pose2>{kStamp, "map", {1, 2, 0}});
  EXPECT_EQ(message.header().stamp().sec(), 1);
  EXPECT_EQ(message.header().stamp().nanosec(), 500'000'000U);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, kStamp);
  EXPECT_EQ(back->frame_id, "map");
  EXPECT_EQ(back->value, (Pose2{1, 2, 0}));
}

TEST(GeometryConversion, a_bad_stamp_makes_a_stamped_pose_bad) {
  auto message = to_msg(Stamped<Pose2>{kStamp, "map", {1, 2, 0}});
  message.header().stamp().nanosec(2'000'000'000);
  EXPECT_FALSE(from_msg(message));
}

TEST(GeometryConversion, a_list_of_poses_keeps_order_and_count) {
  const auto message =
      to_pose_array_msg({kStamp, "map", {Pose2{1, 0, 0}, Pose2{2, 0, 0}, Pose2{3, 0, 0}}});
  ASSERT_EQ(message.poses().size(), 3U);
  auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->value[1], (Pose2{2, 0, 0}));
  auto bad = message;
  bad.poses()[1].position().x(kNan);
  EXPECT_FALSE(from_msg(bad));
}

TEST(GeometryConversion, an_estimate_puts_x_y_yaw_where_the_message_has_them) {
  PoseEstimate estimate{{1, 2, 0}, Eigen::Matrix3d::Zero()};
  estimate.covariance << 4.0, 0.1, 0.2,  //
      0.1, 5.0, 0.3,                     //
      0.2, 0.3, 6.0;
  const auto message = to_msg(Stamped<PoseEstimate>{kStamp, "map", estimate});
  const auto& c = message.pose().covariance();
  EXPECT_EQ(c[0], 4.0);
  EXPECT_EQ(c[1], 0.1);
  EXPECT_EQ(c[5], 0.2);
  EXPECT_EQ(c[7], 5.0);
  EXPECT_EQ(c[11], 0.3);
  EXPECT_EQ(c[35], 6.0);
  EXPECT_EQ(c[14], 0.0);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->value.covariance, estimate.covariance);
  EXPECT_EQ(back->value.pose, estimate.pose);
}

TEST(GeometryConversion, a_transform_survives_the_round_trip) {
  StampedTransform transform{kStamp, "map", "odom", to_pose3({1, 2, 0.3})};
  const auto message = to_msg(transform);
  EXPECT_EQ(message.header().frame_id(), "map");
  EXPECT_EQ(message.child_frame_id(), "odom");
  EXPECT_EQ(message.transform().translation().y(), 2.0);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->parent, "map");
  EXPECT_EQ(back->child, "odom");
  EXPECT_EQ(back->stamp, kStamp);
  EXPECT_TRUE(back->child_in_parent.isApprox(transform.child_in_parent, 1e-14));
}

TEST(GeometryConversion, transforms_without_names_or_in_themselves_are_refused) {
  const auto with_frames = [](const std::string& parent, const std::string& child) {
    return to_msg(StampedTransform{kStamp, parent, child, Pose3::Identity()});
  };
  EXPECT_TRUE(from_msg(with_frames("map", "odom")));
  EXPECT_FALSE(from_msg(with_frames("", "odom")));
  EXPECT_FALSE(from_msg(with_frames("map", "")));
  EXPECT_FALSE(from_msg(with_frames("map", "map")));
}

TEST(GeometryConversion, one_bad_transform_makes_the_message_bad_and_is_named) {
  const std::vector<StampedTransform> transforms{{kStamp, "map", "odom", Pose3::Identity()},
                                                 {kStamp, "odom", "base_link", Pose3::Identity()}};
  auto message = to_msg(std::span(transforms));
  ASSERT_EQ(from_msg(message)->size(), 2U);
  message.transforms()[1].transform().rotation().w(0.0);
  const auto result = from_msg(message);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().find("base_link"), std::string::npos);
}

TEST(GeometryConversion, a_command_is_forward_speed_and_turn_rate) {
  const auto message = to_msg(Stamped<Twist2>{kStamp, "base_link", {0.5, -0.2}});
  EXPECT_EQ(message.twist().linear().x(), 0.5);
  EXPECT_EQ(message.twist().angular().z(), -0.2);
  const auto back = from_msg(message);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->value, (Twist2{0.5, -0.2}));
  EXPECT_EQ(back->frame_id, "base_link");
}

TEST(GeometryConversion, a_command_with_a_number_that_is_none_is_refused) {
  for (int field = 0; field < 6; ++field) {
    auto message = to_msg(Twist2{0.5, 0.1});
    auto& l = message.linear();
    auto& a = message.angular();
    double* fields[] = {&l.x(), &l.y(), &l.z(), &a.x(), &a.y(), &a.z()};
    *fields[field] = kNan;
    EXPECT_FALSE(from_msg(message)) << field;
  }
}

}  // namespace
}  // namespace coop::conversions
