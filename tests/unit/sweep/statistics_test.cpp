#include "sweep/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coop::sweep {
namespace {

TEST(Statistics, student_quantiles_are_those_of_the_tables) {
  EXPECT_NEAR(student_quantile(0.975, 1), 12.7062, 1e-3);
  EXPECT_NEAR(student_quantile(0.975, 2), 4.30265, 1e-4);
  EXPECT_NEAR(student_quantile(0.975, 3), 3.18245, 1e-4);
  EXPECT_NEAR(student_quantile(0.975, 4), 2.77645, 1e-4);
  EXPECT_NEAR(student_quantile(0.975, 5), 2.57058, 1e-4);
  EXPECT_NEAR(student_quantile(0.975, 19), 2.09302, 1e-4);
  EXPECT_NEAR(student_quantile(0.95, 30), 1.69726, 1e-4);
  EXPECT_NEAR(student_quantile(0.975, 100000), 1.95999, 1e-4);
}

/// 134 of 150: middle (p + z^2/2n) / (1 + z^2/n), by hand 0.88315, half width 0.0498.
TEST(Statistics, wilson_interval_of_the_papers_share) {
  const Estimate share = share_of(134, 150);
  EXPECT_NEAR(share.value, 0.8933, 1e-4);
  EXPECT_NEAR(share.low, 0.8339, 1e-3);
  EXPECT_NEAR(share.high, 0.9332, 1e-3);
}

TEST(Statistics, wilson_interval_without_failures_does_not_shrink_to_a_point) {
  const Estimate share = share_of(10, 10);
  EXPECT_DOUBLE_EQ(share.value, 1.0);
  EXPECT_NEAR(share.low, 10.0 / (10.0 + 1.959964 * 1.959964), 1e-6);
  EXPECT_DOUBLE_EQ(share.high, 1.0);
}

/// 1, 2, 3: mean 2, deviation 1, half width 4.30265 / sqrt(3).
TEST(Statistics, mean_of_three_values) {
  const Estimate mean = mean_of({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(mean.value, 2.0);
  EXPECT_NEAR(mean.high - mean.value, 4.30265 / std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(mean.value - mean.low, 4.30265 / std::sqrt(3.0), 1e-4);
}

TEST(Statistics, one_value_says_nothing_of_its_spread) {
  EXPECT_TRUE(std::isinf(mean_of({5.0}).high));
  EXPECT_EQ(mean_of({}).count, 0U);
  EXPECT_EQ(share_of(0, 0).count, 0U);
}

}  // namespace
}  // namespace coop::sweep
