#include "camera_driver/litter.hpp"

#include <gtest/gtest.h>

namespace coop::camera_driver {
namespace {

TEST(Litter, is_the_same_for_a_seed_and_differs_between_seeds) {
  const Litter a(1);
  const Litter again(1);
  const Litter other(2);
  int differing = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = 0.013 * i - 6.0;
    EXPECT_EQ(a.at(x, 2.0, 0), again.at(x, 2.0, 0));
    differing += a.at(x, 2.0, 0) != other.at(x, 2.0, 0) ? 1 : 0;
  }
  EXPECT_GT(differing, 900);
}

TEST(Litter, repeats_after_its_period_on_both_sides_of_zero) {
  const Litter litter(1);
  const double period = 1024 * Litter::kCell;
  for (int level = 0; level < Litter::kLevels; ++level) {
    for (double x = -1.001; x < 1.0; x += 0.05) {
      EXPECT_EQ(litter.at(x, -0.3, level), litter.at(x + period, -0.3 - period, level));
    }
  }
}

TEST(Litter, the_level_is_that_of_the_nearest_cell) {
  EXPECT_EQ(Litter::level_of(0.001), 0);
  EXPECT_EQ(Litter::level_of(0.004), 0);
  EXPECT_EQ(Litter::level_of(0.008), 1);
  EXPECT_EQ(Litter::level_of(0.030), 3);
  EXPECT_EQ(Litter::level_of(1.0), Litter::kLevels - 1);
}

TEST(Litter, a_cell_of_a_higher_level_is_the_mean_of_four_below_it) {
  const Litter litter(1);
  for (int i = 0; i < 50; ++i) {
    const double x = 2.0 * Litter::kCell * i;
    int sum = 0;
    for (const double dx : {0.5, 1.5}) {
      for (const double dy : {0.5, 1.5}) {
        sum += litter.at(x + dx * Litter::kCell, dy * Litter::kCell, 0)[0];
      }
    }
    EXPECT_NEAR(litter.at(x + Litter::kCell, Litter::kCell, 1)[0], sum / 4.0, 1.0);
  }
}

}  // namespace
}  // namespace coop::camera_driver
