#include "core/odometry_track.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "unit/core/at.hpp"

namespace coop {
namespace {

using test::at;

TEST(OdometryTrack, InterpolatesBetweenReadingsTheShortWayRound) {
  OdometryTrack track;
  track.insert({at(1.0), {0.0, 0.0, 3.1}});
  track.insert({at(2.0), {1.0, 2.0, -3.1}});
  const auto pose = track.at(at(1.25));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->base_in_odom.x, 0.25, 1e-12);
  EXPECT_NEAR(pose->base_in_odom.y, 0.5, 1e-12);
  EXPECT_NEAR(pose->base_in_odom.yaw, 3.1 + 0.25 * (2 * std::numbers::pi - 6.2), 1e-9);
}

TEST(OdometryTrack, SaysWhetherAbsentOdometryMayStillCome) {
  OdometryTrack track;
  EXPECT_EQ(track.at(at(1.0)).error(), OdometryTrack::Absence::kNotYet);
  track.insert({at(1.0), {}});
  EXPECT_EQ(track.at(at(1.1)).error(), OdometryTrack::Absence::kNotYet);
  EXPECT_EQ(track.at(at(0.9)).error(), OdometryTrack::Absence::kTooOld);
  EXPECT_TRUE(track.at(at(1.0)));
}

TEST(OdometryTrack, ReadingsThatRunBackInTimeAreSortedIn) {
  OdometryTrack track;
  track.insert({at(1.0), {1.0, 0.0, 0.0}});
  track.insert({at(3.0), {3.0, 0.0, 0.0}});
  track.insert({at(2.0), {5.0, 0.0, 0.0}});
  EXPECT_NEAR(track.at(at(2.5))->base_in_odom.x, 4.0, 1e-12);
}

TEST(OdometryTrack, OfEqualStampsTheLaterReadingIsTheAnswer) {
  OdometryTrack track;
  track.insert({at(1.0), {1.8, 0.0, 0.0}});
  track.insert({at(1.0), {2.0, 0.0, 0.0}});
  track.insert({at(2.0), {4.0, 0.0, 0.0}});
  EXPECT_NEAR(track.at(at(1.0))->base_in_odom.x, 2.0, 1e-12);
  EXPECT_NEAR(track.at(at(1.5))->base_in_odom.x, 3.0, 1e-12);
  EXPECT_EQ(track.readings().size(), 3U);
}

TEST(OdometryTrack, ThinsTheOlderHalfWhenFull) {
  OdometryTrack track(8);
  for (int i = 0; i < 9; ++i) track.insert({at(i), {static_cast<double>(i), 0.0, 0.0}});
  ASSERT_EQ(track.readings().size(), 7U);
  const double kept[] = {0, 2, 4, 5, 6, 7, 8};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(track.readings()[i].pose.x, kept[i]);
}

void expect_pose(const Result<OdometryFix, OdometryTrack::Absence>& fix, const Pose2& expected) {
  ASSERT_TRUE(fix);
  EXPECT_NEAR(distance(fix->base_in_odom, expected), 0.0, 1e-12);
  EXPECT_NEAR(angle_difference(fix->base_in_odom.yaw, expected.yaw), 0.0, 1e-12);
}

TEST(OdometryTrack, AnotherSourceContinuesWhereTheLastOneEnded) {
  OdometryTrack track;
  EXPECT_FALSE(track.insert({at(1.0), {5.0, 2.0, 0.0}}, "one"));
  EXPECT_FALSE(track.insert({at(2.0), {5.1, 2.0, 0.5 * std::numbers::pi}}, "one"));
  // The driver begins again at zero; in the second that it was away anything up to 3 m would do.
  EXPECT_TRUE(track.insert({at(3.0), {0.0, 0.0, 0.0}}, "two"));
  EXPECT_FALSE(track.insert({at(3.2), {0.2, 0.0, 0.0}}, "two"));
  expect_pose(track.at(at(2.0)), {5.1, 2.0, 0.5 * std::numbers::pi});
  expect_pose(track.at(at(3.0)), {5.1, 2.0, 0.5 * std::numbers::pi});
  expect_pose(track.at(at(3.1)), {5.1, 2.1, 0.5 * std::numbers::pi});
  EXPECT_EQ(track.at(at(1.5))->piece, 0U);
  EXPECT_EQ(track.at(at(3.1))->piece, 1U);
  // Today's odometry taken to the track is the track.
  const Pose2 end = track.odom_in_track() * Pose2{0.2, 0.0, 0.0};
  EXPECT_NEAR(distance(end, {5.1, 2.2, 0.0}), 0.0, 1e-12);
}

TEST(OdometryTrack, BetweenTwoPiecesNobodyKnows) {
  OdometryTrack track;
  track.insert({at(1.0), {1.0, 0.0, 0.0}}, "one");
  track.insert({at(2.0), {0.0, 0.0, 0.0}}, "two");
  EXPECT_EQ(track.at(at(1.5)).error(), OdometryTrack::Absence::kGap);
}

TEST(OdometryTrack, AStepThatNothingOnWheelsDoesIsARestart) {
  OdometryTrack track(100, {.plausible_speed = 3.0, .slack = 0.1});
  track.insert({at(1.0), {0.0, 0.0, 0.0}});
  EXPECT_FALSE(track.insert({at(1.1), {0.59, 0.0, 0.0}}));  // 3 m/s for 0.2 s are 0.6 m
  EXPECT_TRUE(track.insert({at(1.2), {1.20, 0.0, 0.0}}));
  EXPECT_TRUE(track.insert({at(1.3), {1.20, 0.0, 0.61}}));  // 0.6 rad
  EXPECT_FALSE(track.insert({at(2.3), {-2.0, 0.0, 0.61}})) << "3.2 m in a second and a little";
  EXPECT_EQ(track.at(at(1.3))->piece, 2U);
  EXPECT_NEAR(track.at(at(1.3))->base_in_odom.x, 0.59, 1e-12);
}

TEST(OdometryTrack, ALateReadingGoesWithThePieceOfItsTime) {
  OdometryTrack track;
  track.insert({at(1.0), {5.0, 0.0, 0.0}}, "one");
  track.insert({at(2.0), {5.0, 0.0, 0.0}}, "one");
  track.insert({at(3.0), {0.0, 0.0, 0.0}}, "two");
  track.insert({at(1.5), {5.4, 0.0, 0.0}});
  expect_pose(track.at(at(1.5)), {5.4, 0.0, 0.0});
}

TEST(OdometryTrack, ASuccessorWhoseClockLagsReplacesWhatWasSaidOfItsTime) {
  OdometryTrack track;
  track.insert({at(1.0), {5.0, 0.0, 0.0}}, "one");
  track.insert({at(2.0), {6.0, 0.0, 0.0}}, "one");
  EXPECT_TRUE(track.insert({at(1.9), {0.0, 0.0, 0.0}}, "two"));
  EXPECT_FALSE(track.insert({at(2.1), {0.1, 0.0, 0.0}}, "two"));
  expect_pose(track.at(at(2.0)), {6.05, 0.0, 0.0});
}

TEST(OdometryTrack, GoesOnFromWhatAnotherProcessLeft) {
  OdometryTrack track;
  track.resume({{at(1.0), {5.0, 2.0, 0.0}}}, {4.0, 2.0, 0.0}, "one");
  // The same driver has driven on: 1.0 is 5.0 in the track.
  EXPECT_FALSE(track.insert({at(2.0), {1.5, 0.0, 0.0}}, "one"));
  expect_pose(track.at(at(2.0)), {5.5, 2.0, 0.0});
  track.resume({{at(1.0), {5.0, 2.0, 0.0}}}, {4.0, 2.0, 0.0}, "one");
  EXPECT_TRUE(track.insert({at(2.0), {0.0, 0.0, 0.0}}, "two"));
  expect_pose(track.at(at(2.0)), {5.0, 2.0, 0.0});
}

TEST(OdometryTrack, AReadingToldAgainChangesNothing) {
  OdometryTrack track;
  for (const char* life : {"one", "two"}) {
    for (const double t : {1.0, 2.0, 3.0}) {
      EXPECT_FALSE(track.insert({time_from_seconds(t), {t, 0.0, 0.0}}, life));
    }
  }
  EXPECT_EQ(track.readings().size(), 3U);
  track.insert({time_from_seconds(2.0), {5.0, 0.0, 0.0}}, "two");
  EXPECT_EQ(track.readings().size(), 4U) << "the same stamp with another pose is another reading";
}

TEST(OdometryTrack, AnotherSourceThatGoesOnWhereTheLastOneWasIsNoRestart) {
  OdometryTrack track;
  track.insert({at(1.0), {5.0, 2.0, 0.0}}, "one");
  EXPECT_FALSE(track.insert({at(1.1), {5.1, 2.0, 0.0}}, "two"));   // 0.05 m + 1 m/s for 0.1 s
  EXPECT_TRUE(track.insert({at(1.2), {5.3, 2.0, 0.0}}, "three"));  // 0.2 m
}

}  // namespace
}  // namespace coop
