#include "core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace coop {
namespace {

TEST(RandomTest, TheSameSeedAndNameGiveTheSameNumbers) {
  RandomStream a(7, "amcl/motion");
  RandomStream b(7, "amcl/motion");
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a(), b());
}

TEST(RandomTest, AnotherNameOrSeedGivesOtherNumbers) {
  RandomStream a(7, "amcl/motion");
  RandomStream b(7, "amcl/recovery");
  RandomStream c(8, "amcl/motion");
  const auto first = a();
  EXPECT_NE(first, b());
  EXPECT_NE(first, c());
}

TEST(RandomTest, NormalDeviatesHaveMeanZeroAndDeviationOne) {
  RandomStream stream(1, "test");
  constexpr int kDraws = 200000;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = stream.normal();
    sum += x;
    squares += x * x;
  }
  // Five standard errors of each.
  EXPECT_NEAR(sum / kDraws, 0.0, 5 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 5 * std::sqrt(2.0 / kDraws));
}

TEST(RandomTest, BelowIsEvenAndWithinItsBound) {
  RandomStream stream(1, "test");
  std::array<int, 6> counts{};
  for (int i = 0; i < 60000; ++i) ++counts.at(stream.below(6));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
}

}  // namespace
}  // namespace coop
