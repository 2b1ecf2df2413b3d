#include "core/transform_buffer.hpp"

#include <gtest/gtest.h>

#include "unit/core/at.hpp"

namespace coop {
namespace {

using test::at;

class TransformBufferTest : public ::testing::Test {
 protected:
  TransformBufferTest() {
    buffer_.insert_static("base_link", "laser_link", to_pose3({0.5, 0, 0}));
    buffer_.insert("odom", "base_link", at(10), to_pose3({0, 0, 0}));
    buffer_.insert("odom", "base_link", at(11), to_pose3({1, 0, 1.0}));
    buffer_.insert("map", "odom", at(9), to_pose3({5, 5, 0}));
    buffer_.insert("map", "odom", at(12), to_pose3({5, 5, 0}));
  }
  TransformBuffer buffer_{std::chrono::seconds(15)};
};

TEST_F(TransformBufferTest, APoseBetweenTwoSamplesIsInterpolated) {
  const auto pose = buffer_.lookup("odom", "base_link", at(10.5));
  ASSERT_TRUE(pose);
  const Pose2 base_in_odom = to_pose2(*pose);
  EXPECT_NEAR(base_in_odom.x, 0.5, 1e-12);
  EXPECT_NEAR(base_in_odom.yaw, 0.5, 1e-12);
}

TEST_F(TransformBufferTest, ChainsAreComposedUpAndDown) {
  const auto laser_in_map = buffer_.lookup("map", "laser_link", at(10));
  ASSERT_TRUE(laser_in_map);
  EXPECT_NEAR(to_pose2(*laser_in_map).x, 5.5, 1e-12);
  const auto map_in_laser = buffer_.lookup("laser_link", "map", at(10));
  ASSERT_TRUE(map_in_laser);
  EXPECT_NEAR(to_pose2(*map_in_laser).x, -5.5, 1e-12);
  EXPECT_NEAR(to_pose2(*map_in_laser).y, -5.0, 1e-12);
}

TEST_F(TransformBufferTest, AbsenceIsAnErrorWithItsReason) {
  EXPECT_EQ(buffer_.lookup("odom", "base_link", at(11.1)).error(), TransformError::kNotYet);
  EXPECT_EQ(buffer_.lookup("odom", "base_link", at(9.9)).error(), TransformError::kTooOld);
  EXPECT_EQ(buffer_.lookup("odom", "moon", at(10)).error(), TransformError::kUnknownFrame);
  buffer_.insert_static("moon", "crater", Pose3::Identity());
  EXPECT_EQ(buffer_.lookup("odom", "crater", at(10)).error(), TransformError::kNotConnected);
}

TEST_F(TransformBufferTest, TheNewestStampIsThatOfTheSlowestLink) {
  EXPECT_EQ(buffer_.newest_stamp("map", "laser_link").value(), at(11));
  EXPECT_EQ(buffer_.newest_stamp("base_link", "laser_link").value(), Time::max());
}

TEST_F(TransformBufferTest, AStampThatRunsBackALittleIsSortedIn) {
  buffer_.insert("odom", "base_link", at(10.8), to_pose3({0, 2, 0}));
  EXPECT_NEAR(to_pose2(*buffer_.lookup("odom", "base_link", at(10.8))).y, 2, 1e-12);
  EXPECT_TRUE(buffer_.lookup("odom", "base_link", at(11)));
}

TEST_F(TransformBufferTest, AClockSetFarBackStartsTheHistoryAnew) {
  buffer_.insert("odom", "base_link", at(100), to_pose3({3, 0, 0}));
  buffer_.insert("odom", "base_link", at(1), to_pose3({4, 0, 0}));
  EXPECT_EQ(buffer_.lookup("odom", "base_link", at(100)).error(), TransformError::kNotYet);
  EXPECT_NEAR(to_pose2(*buffer_.lookup("odom", "base_link", at(1))).x, 4, 1e-12);
}

TEST_F(TransformBufferTest, ALoopOfFramesEndsInAnErrorNotInALoop) {
  buffer_.insert_static("a", "b", Pose3::Identity());
  buffer_.insert_static("b", "a", Pose3::Identity());
  EXPECT_FALSE(buffer_.lookup("a", "laser_link", at(10)));
}

TEST_F(TransformBufferTest, HistoryBeyondItsLengthIsForgotten) {
  buffer_.insert("odom", "base_link", at(26), to_pose3({0, 0, 0}));
  EXPECT_EQ(buffer_.lookup("odom", "base_link", at(10.5)).error(), TransformError::kTooOld);
}

TEST_F(TransformBufferTest, TheNewestPoseIsThatOfTheSlowestLinkUnlessItIsTooOld) {
  const auto pose = newest_pose(buffer_, "map", "base_link", at(11.4), seconds(0.5));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->stamp, at(11));
  EXPECT_NEAR(pose->pose.x, 6, 1e-12);
  EXPECT_FALSE(newest_pose(buffer_, "map", "base_link", at(11.6), seconds(0.5)));
  EXPECT_TRUE(newest_pose(buffer_, "map", "base_link", at(99)));
  EXPECT_FALSE(newest_pose(buffer_, "map", "moon", at(11)));
}

TEST_F(TransformBufferTest, ATransformThatHoldsLongerIsOfNow) {
  const auto pose = newest_pose(buffer_, "map", "odom", at(11.5), seconds(0.5));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->stamp, at(11.5));
}

}  // namespace
}  // namespace coop
