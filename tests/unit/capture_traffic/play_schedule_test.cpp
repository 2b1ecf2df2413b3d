#include "capture/traffic/play_schedule.hpp"

#include <gtest/gtest.h>

namespace coop::capture {
namespace {

using Wall = PlaySchedule::Wall;
using std::chrono::milliseconds;

const Time kBegin = time_from_seconds(1000.0);
const Wall kStart{std::chrono::hours(5)};

TEST(PlaySchedule, NothingIsDueBeforeItStarts) {
  const PlaySchedule schedule(1.0);
  EXPECT_FALSE(schedule.is_due(kBegin, kStart));
}

TEST(PlaySchedule, DeadlinesAreAbsoluteAtAnyRate) {
  for (const double rate : {0.5, 1.0, 3.0}) {
    PlaySchedule schedule(rate);
    schedule.start(kBegin, kStart);
    for (int i = 0; i < 100'000; i += 997) {
      const Time log = kBegin + milliseconds(i * 10);
      const auto exact =
          kStart + std::chrono::nanoseconds(static_cast<std::int64_t>(i * 10e6 / rate + 0.5));
      EXPECT_LE(std::chrono::abs(schedule.due(log) - exact), std::chrono::nanoseconds(1));
    }
    EXPECT_TRUE(schedule.is_due(kBegin, kStart));
  }
}

TEST(PlaySchedule, PositionIsWhereDeadlinesAre) {
  PlaySchedule schedule(2.0);
  schedule.start(kBegin, kStart);
  EXPECT_EQ(schedule.position(kStart + milliseconds(1500)), kBegin + milliseconds(3000));
  EXPECT_EQ(schedule.due(kBegin + milliseconds(3000)), kStart + milliseconds(1500));
}

TEST(PlaySchedule, APauseMovesEverythingBehindItByItsLength) {
  PlaySchedule schedule(1.0);
  schedule.start(kBegin, kStart);
  schedule.pause(kStart + milliseconds(400));
  EXPECT_TRUE(schedule.paused());
  EXPECT_EQ(schedule.due(kBegin + milliseconds(500)), Wall::max());
  EXPECT_TRUE(schedule.is_due(kBegin + milliseconds(400), kStart + milliseconds(400)));
  EXPECT_EQ(schedule.position(kStart + std::chrono::hours(1)), kBegin + milliseconds(400));
  schedule.resume(kStart + milliseconds(10'000));
  EXPECT_EQ(schedule.due(kBegin + milliseconds(500)), kStart + milliseconds(10'100));
}

TEST(PlaySchedule, StepsByHandWhilePausedAndNeverBack) {
  PlaySchedule schedule(1.0);
  schedule.start(kBegin, kStart);
  schedule.move_to(kBegin + milliseconds(700));
  EXPECT_EQ(schedule.position(kStart), kBegin) << "it is not paused";
  schedule.pause(kStart);
  schedule.move_to(kBegin + milliseconds(700));
  schedule.move_to(kBegin + milliseconds(300));
  EXPECT_EQ(schedule.position(kStart), kBegin + milliseconds(700));
  EXPECT_TRUE(schedule.is_due(kBegin + milliseconds(700), kStart));
  schedule.resume(kStart + milliseconds(50));
  EXPECT_EQ(schedule.due(kBegin + milliseconds(800)), kStart + milliseconds(150));
}

TEST(PlaySchedule, AsFastAsPossibleEverythingIsDueUnlessPaused) {
  PlaySchedule schedule(0.0);
  schedule.start(kBegin, kStart);
  EXPECT_TRUE(schedule.is_due(kBegin + std::chrono::hours(9), kStart));
  schedule.move_to(kBegin + std::chrono::hours(9));
  schedule.pause(kStart);
  EXPECT_FALSE(schedule.is_due(kBegin + std::chrono::hours(10), kStart + milliseconds(1)));
  EXPECT_EQ(schedule.position(kStart + milliseconds(1)), kBegin + std::chrono::hours(9));
}

}  // namespace
}  // namespace coop::capture
