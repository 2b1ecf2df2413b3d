#include "capture/traffic/lockstep_script.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace coop::capture {
namespace {

/// The simulator writes scan and the latched world; lidar writes one more topic; amcl reads all.
RecordedRoster roster(std::uint32_t round = 1, std::uint64_t epoch = 7) {
  return {.epoch = epoch,
          .round = round,
          .members = {{"amcl", {{"a0", false, false, 0}, {"a1", true, false, 0}}},
                      {"lidar", {{"l0", true, false, 3}}},
                      {"simulator", {{"s0", true, false, 0}, {"s1", true, true, 2}}}}};
}

RecordedOrder order(std::uint64_t tick, std::vector<RecordedOrder::Mark> marks,
                    std::uint32_t round = 1) {
  return {.epoch = 7,
          .round = round,
          .tick = tick,
          .time = time_from_seconds(1000.0 + 0.01 * static_cast<double>(tick)),
          .marks = std::move(marks)};
}

TEST(LockstepScript, TellsTheTickInWhichASampleWasHandledFirst) {
  const LockstepScript script({roster()}, {order(1, {{2, 0, 1}}), order(4, {{2, 0, 3}, {1, 0, 5}}),
                                           order(6, {{2, 0, 3}, {2, 0, 4}})});
  EXPECT_EQ(script.tick_of("s0", 1), 1U);
  EXPECT_EQ(script.tick_of("s0", 2), 4U);
  EXPECT_EQ(script.tick_of("s0", 3), 4U);
  EXPECT_EQ(script.tick_of("s0", 4), 6U);
  EXPECT_EQ(script.tick_of("s0", 5), std::nullopt) << "no order names it";
  EXPECT_EQ(script.tick_of("l0", 4), 4U);
  EXPECT_EQ(script.tick_of("unknown", 1), std::nullopt);
}

TEST(LockstepScript, AReaderWhoGotItEarlierCounts) {
  // A patient reader had to have everything up to 4 at tick 9; another one had 4 at tick 5.
  const LockstepScript script({roster()}, {order(9, {{2, 0, 3}}), order(5, {{2, 0, 4}})});
  EXPECT_EQ(script.tick_of("s0", 3), 5U);
}

TEST(LockstepScript, WhatWasWrittenBeforeTheFirstRoundIsThereOnlyWhereItIsLatched) {
  const LockstepScript script({roster()}, {order(1, {{2, 1, 3}})});
  EXPECT_EQ(script.tick_of("s1", 2), 0U);
  EXPECT_EQ(script.tick_of("s1", 3), 1U);
  EXPECT_EQ(script.tick_of("l0", 3), std::nullopt);
}

TEST(LockstepScript, TicksAreInOrderWithTheirTimes) {
  const LockstepScript script({roster(), roster(2)}, {order(5, {}, 2), order(1, {}), order(5, {})});
  ASSERT_EQ(script.ticks().size(), 2U);
  EXPECT_EQ(script.ticks()[0].number, 1U);
  EXPECT_EQ(script.ticks()[1].time, time_from_seconds(1000.05));
}

TEST(LockstepScript, WritersAreRankedByComponentAndPlace) {
  const LockstepScript script({roster()}, {});
  EXPECT_LT(script.rank_of("a1"), script.rank_of("l0"));
  EXPECT_LT(script.rank_of("s0"), script.rank_of("s1"));
  EXPECT_EQ(script.rank_of("unknown"), std::nullopt);
}

TEST(LockstepScript, RefusesTwoLivesOfTheMaster) {
  EXPECT_THROW(LockstepScript({roster(1, 7), roster(1, 8)}, {}), std::invalid_argument);
}

TEST(LockstepScript, MarksThatPointNowhereAreLeftOut) {
  const LockstepScript script({roster()}, {order(1, {{9, 0, 1}, {2, 9, 1}, {0, 0, 1}})});
  EXPECT_EQ(script.tick_of("s0", 1), std::nullopt);
}

}  // namespace
}  // namespace coop::capture
