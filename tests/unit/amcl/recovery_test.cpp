#include "amcl/recovery.hpp"

#include <gtest/gtest.h>

namespace coop::amcl {
namespace {

TEST(Recovery, AddsNothingWhileScansFitAsBefore) {
  Recovery recovery(
      {.slow_rate = 0.1, .fast_rate = 0.5, .tolerance = 1.0, .max_random_share = 1.0});
  for (int i = 0; i < 50; ++i) EXPECT_DOUBLE_EQ(recovery.update(0.8), 0.0);
}

TEST(Recovery, AddsWhatTheShortAverageFallsBelowTheLong) {
  Recovery recovery(
      {.slow_rate = 0.1, .fast_rate = 0.5, .tolerance = 1.0, .max_random_share = 1.0});
  EXPECT_DOUBLE_EQ(recovery.update(0.8), 0.0);
  // slow = 0.8 + 0.1 (0.2 - 0.8) = 0.74, fast = 0.8 + 0.5 (0.2 - 0.8) = 0.5
  EXPECT_NEAR(recovery.update(0.2), 1.0 - 0.5 / 0.74, 1e-12);
}

TEST(Recovery, NeverAddsMoreThanItsLimitAndNothingWhenScansFitBetter) {
  Recovery recovery(
      {.slow_rate = 0.01, .fast_rate = 0.9, .tolerance = 1.0, .max_random_share = 0.25});
  EXPECT_DOUBLE_EQ(recovery.update(0.1), 0.0);
  EXPECT_DOUBLE_EQ(recovery.update(0.9), 0.0);
  for (int i = 0; i < 5; ++i) (void)recovery.update(0.001);
  EXPECT_DOUBLE_EQ(recovery.update(0.001), 0.25);
}

TEST(Recovery, ToleratesScansThatFitALittleWorse) {
  Recovery recovery(
      {.slow_rate = 0.1, .fast_rate = 0.5, .tolerance = 1.4, .max_random_share = 1.0});
  (void)recovery.update(0.8);
  // slow = 0.77, fast = 0.65: 1 - 1.4 * 0.65 / 0.77 is below zero.
  EXPECT_DOUBLE_EQ(recovery.update(0.5), 0.0);
  // slow = 0.703, fast = 0.375
  EXPECT_NEAR(recovery.update(0.1), 1.0 - 1.4 * 0.375 / 0.703, 1e-12);
}

TEST(Recovery, ForgetsWhenReset) {
  Recovery recovery(
      {.slow_rate = 0.1, .fast_rate = 0.5, .tolerance = 1.0, .max_random_share = 1.0});
  (void)recovery.update(0.8);
  recovery.reset();
  EXPECT_DOUBLE_EQ(recovery.update(0.2), 0.0);
}

TEST(Recovery, IsSwitchedOffByAZeroRate) {
  Recovery recovery(
      {.slow_rate = 0.0, .fast_rate = 0.5, .tolerance = 1.0, .max_random_share = 1.0});
  (void)recovery.update(0.8);
  EXPECT_DOUBLE_EQ(recovery.update(0.01), 0.0);
}

}  // namespace
}  // namespace coop::amcl
