#include "chassis_driver/playback.hpp"

#include <gtest/gtest.h>

namespace coop::chassis_driver {
namespace {

using namespace std::chrono_literals;

Time at(double s) {
  return time_from_seconds(s);
}
const Time kBegin = at(5000.0);
const Time kEnd = at(5010.0);

TEST(Playback, BeginsWithTheFirstStampWheneverThatIs) {
  Playback playback({.rate = 2.0}, kBegin, kEnd);
  EXPECT_FALSE(playback.started());
  EXPECT_EQ(playback.next(at(100.0)), kBegin);
  playback.advance(kBegin);
  EXPECT_TRUE(playback.started());
  EXPECT_FALSE(playback.next(at(100.0)).has_value());
}

TEST(Playback, GoesOnWhereAnEarlierLifeHadCome) {
  Playback playback({.rate = 2.0}, kBegin, kEnd);
  playback.resume(kBegin + 4s);
  EXPECT_EQ(playback.next(at(100.0)), kBegin + 4s);
  playback.advance(kBegin + 4s);
  EXPECT_EQ(playback.next(at(100.01)), kBegin + 4020ms);
}

TEST(Playback, APositionOutsideTheSectionIsBroughtIntoIt) {
  Playback playback({.start = 2.0, .duration = 3.0}, kBegin, kEnd);
  playback.resume(kBegin);
  EXPECT_EQ(playback.next(at(100.0)), kBegin + 2s);
  playback.resume(kEnd);
  EXPECT_EQ(playback.next(at(100.0)), kBegin + 5s);
  playback.advance(kBegin + 5s);
  EXPECT_TRUE(playback.at_end());
}

TEST(Playback, RunsAtItsRate) {
  Playback playback({.rate = 4.0}, kBegin, kEnd);
  playback.advance(*playback.next(at(100.0)));
  EXPECT_EQ(playback.next(at(100.02)), kBegin + 80ms);
  playback.advance(kBegin + 80ms);
  EXPECT_EQ(playback.next(at(100.025)), kBegin + 100ms);
}

TEST(Playback, MovesInStepsOfATenthOfASecondAtMost) {
  Playback playback({.rate = 10.0}, kBegin, kEnd);
  playback.advance(*playback.next(at(100.0)));
  Time last = kBegin;
  int steps = 0;
  while (const auto step = playback.next(at(100.05))) {  // half a second of the log is due
    EXPECT_LE(*step - last, 100ms);
    playback.advance(*step);
    last = *step;
    ++steps;
  }
  EXPECT_EQ(last, kBegin + 500ms);
  EXPECT_EQ(steps, 5);
}

TEST(Playback, AsksAgainForAStepThatWasNotPublished) {
  Playback playback({.rate = 1.0}, kBegin, kEnd);
  playback.advance(*playback.next(at(100.0)));
  EXPECT_EQ(playback.next(at(100.05)), kBegin + 50ms);
  EXPECT_EQ(playback.next(at(100.06)), kBegin + 60ms);  // later: a little more is due
}

TEST(Playback, DoesNotHurryAfterTimeSpentBlocked) {
  Playback playback({.rate = 1.0}, kBegin, kEnd);
  playback.advance(*playback.next(at(100.0)));
  EXPECT_FALSE(playback.next(at(105.0)).has_value());  // five seconds lost: goes on from here
  EXPECT_EQ(playback.next(at(105.02)), kBegin + 20ms);
}

TEST(Playback, WithoutARateEveryStepIsDueAtOnce) {
  Playback playback({.rate = 0.0}, kBegin, kEnd);
  int steps = 0;
  while (const auto step = playback.next(at(100.0))) {
    playback.advance(*step);
    ++steps;
  }
  EXPECT_TRUE(playback.at_end());
  EXPECT_EQ(steps, 101);
}

TEST(Playback, EndsWithTheLastStamp) {
  Playback playback({.rate = 0.0}, kBegin, kBegin + 150ms);
  playback.advance(*playback.next(at(1.0)));
  playback.advance(*playback.next(at(1.0)));
  EXPECT_EQ(playback.next(at(1.0)), kBegin + 150ms);
  playback.advance(kBegin + 150ms);
  EXPECT_TRUE(playback.at_end());
  EXPECT_FALSE(playback.next(at(2.0)).has_value());
}

TEST(Playback, PlaysASection) {
  const Playback section({.rate = 1.0, .start = 2.0, .duration = 3.0}, kBegin, kEnd);
  EXPECT_EQ(section.begin(), kBegin + 2s);
  EXPECT_EQ(section.end(), kBegin + 5s);
  const Playback beyond({.rate = 1.0, .start = 99.0, .duration = 3.0}, kBegin, kEnd);
  EXPECT_EQ(beyond.begin(), kEnd);
  EXPECT_EQ(beyond.end(), kEnd);
}

}  // namespace
}  // namespace coop::chassis_driver
