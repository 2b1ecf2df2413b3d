#include "slam/odometry_track.hpp"

#include <gtest/gtest.h>

namespace coop::slam {
namespace {

Time at(double seconds) {
  return time_from_seconds(seconds);
}

TEST(OdometryTrack, InterpolatesBetweenReadingsTheShortWayRound) {
  OdometryTrack track;
  track.insert({at(1.0), {0.0, 0.0, 3.1}});
  track.insert({at(2.0), {2.0, 4.0, -3.1}});
  const auto pose = track.at(at(1.25));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x, 0.5, 1e-12);
  EXPECT_NEAR(pose->y, 1.0, 1e-12);
  EXPECT_NEAR(pose->yaw, 3.1 + 0.25 * (2 * std::numbers::pi - 6.2), 1e-9);
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
  EXPECT_NEAR(track.at(at(2.5))->x, 4.0, 1e-12);
}

TEST(OdometryTrack, OfEqualStampsTheLaterReadingIsTheAnswer) {
  OdometryTrack track;
  track.insert({at(1.0), {1.0, 0.0, 0.0}});
  track.insert({at(1.0), {2.0, 0.0, 0.0}});
  track.insert({at(2.0), {4.0, 0.0, 0.0}});
  EXPECT_NEAR(track.at(at(1.0))->x, 2.0, 1e-12);
  EXPECT_NEAR(track.at(at(1.5))->x, 3.0, 1e-12);
  EXPECT_EQ(track.readings().size(), 3U);
}

TEST(OdometryTrack, ThinsTheOlderHalfWhenFull) {
  OdometryTrack track(8);
  for (int i = 0; i < 9; ++i) track.insert({at(i), {static_cast<double>(i), 0.0, 0.0}});
  ASSERT_EQ(track.readings().size(), 7U);
  const double kept[] = {0, 2, 4, 5, 6, 7, 8};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(track.readings()[i].pose.x, kept[i]);
}

TEST(OdometryTrack, AReadingToldAgainChangesNothing) {
  OdometryTrack track;
  for (int life = 0; life < 2; ++life) {
    for (const double t : {1.0, 2.0, 3.0}) track.insert({time_from_seconds(t), {t, 0.0, 0.0}});
  }
  EXPECT_EQ(track.readings().size(), 3U);
  track.insert({time_from_seconds(2.0), {5.0, 0.0, 0.0}});
  EXPECT_EQ(track.readings().size(), 4U) << "the same stamp with another pose is another reading";
}

}  // namespace
}  // namespace coop::slam
