#include "amcl/resampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace coop::amcl {
namespace {

const ParticleSet kNone;

TEST(KldBound, AgreesWithTheChiSquareQuantileItApproximates) {
  // The bound is the 99 % quantile of chi-square with k - 1 degrees over 2 * error; the quantiles
  // are from tables.
  EXPECT_EQ(kld_bound(0, 0.05, 2.3263), 1u);
  EXPECT_EQ(kld_bound(1, 0.05, 2.3263), 1u);
  EXPECT_NEAR(static_cast<double>(kld_bound(11, 0.05, 2.3263)), 23.209 / 0.1, 2.0);
  EXPECT_NEAR(static_cast<double>(kld_bound(31, 0.05, 2.3263)), 50.892 / 0.1, 2.0);
  EXPECT_NEAR(static_cast<double>(kld_bound(101, 0.01, 2.3263)), 135.807 / 0.02, 10.0);
}

TEST(Resampler, DrawsAsManyParticlesAsTheFilledBinsAskFor) {
  const KldConfig config{.min_particles = 20, .max_particles = 5000, .bin_size = 1.0};
  Resampler resampler(config);
  RandomStream random(1, "test");
  ParticleSet from;
  ParticleSet to;
  from.push_back({0.5, 0.5, 0.05}, 1.0F);
  resampler.resample(from, 0.0, kNone, random, to);
  EXPECT_EQ(to.size(), 20u) << "one bin: the least";

  from.clear();
  for (int i = 0; i < 30; ++i) from.push_back({i + 0.5, 0.5, 0.05}, 1.0F);
  resampler.resample(from, 0.0, kNone, random, to);
  EXPECT_EQ(to.size(), kld_bound(30, config.error, config.quantile));

  from.clear();
  for (int i = 0; i < 4000; ++i) from.push_back({i + 0.5, 0.5, 0.05}, 1.0F);
  resampler.resample(from, 0.0, kNone, random, to);
  EXPECT_EQ(to.size(), 5000u) << "thousands of bins: the most";
}

TEST(Resampler, DrawsEachParticleInProportionToItsWeightWithLowVariance) {
  // All in one bin, so that exactly min_particles are drawn.
  Resampler resampler({.min_particles = 1000, .max_particles = 1000, .bin_size = 100.0});
  RandomStream random(9, "test");
  RandomStream weights(10, "weights");
  ParticleSet from;
  float total = 0.0F;
  for (int i = 0; i < 50; ++i) {
    from.push_back({i + 0.5, 0.5, 0.05}, static_cast<float>(weights.uniform(0.1, 3.0)));
    total += from.weight.back();
  }
  std::map<int, double> mean;
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    ParticleSet to;
    resampler.resample(from, 0.0, kNone, random, to);
    ASSERT_EQ(to.size(), 1000u);
    std::map<int, int> count;
    for (const float x : to.x) ++count[static_cast<int>(x)];
    for (int i = 0; i < 50; ++i) {
      const double expected =
          1000.0 * static_cast<double>(from.weight[static_cast<std::size_t>(i)] / total);
      // Independent draws would deviate by about sqrt(20) = 4.5 as a rule and by 15 at times.
      EXPECT_NEAR(count[i], expected, 3.0);
      mean[i] += count[i] / static_cast<double>(kRounds);
    }
  }
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(mean[i],
                1000.0 * static_cast<double>(from.weight[static_cast<std::size_t>(i)] / total),
                0.4);
  }
}

TEST(Resampler, ResultIsNormalisedAndNeverHoldsAParticleWithoutWeight) {
  Resampler resampler({.min_particles = 300, .max_particles = 300});
  RandomStream random(4, "test");
  ParticleSet from;
  from.push_back({1, 0, 0}, 0.0F);
  from.push_back({2, 0, 0}, 0.5F);
  from.push_back({3, 0, 0}, 0.0F);
  ParticleSet to;
  resampler.resample(from, 0.0, kNone, random, to);
  double sum = 0.0;
  for (std::size_t i = 0; i < to.size(); ++i) {
    EXPECT_FLOAT_EQ(to.x[i], 2.0F);
    sum += static_cast<double>(to.weight[i]);
  }
  EXPECT_NEAR(sum, 1.0, 1e-5);
}

TEST(Resampler, AddsTheAskedShareOfFreshPosesByTheirWeight) {
  Resampler resampler({.min_particles = 10000, .max_particles = 10000});
  RandomStream random(4, "test");
  ParticleSet from;
  from.push_back({0, 0, 0}, 1.0F);
  ParticleSet fresh;
  fresh.push_back({-100, 0, 0}, 3.0F);
  fresh.push_back({-200, 0, 0}, 1.0F);
  ParticleSet to;
  resampler.resample(from, 0.2, fresh, random, to);
  int first = 0;
  int second = 0;
  for (const float x : to.x) {
    first += x < -50.0F && x > -150.0F ? 1 : 0;
    second += x < -150.0F ? 1 : 0;
  }
  EXPECT_NEAR(first + second, 2000, 150);
  EXPECT_NEAR(first, 3 * second, 10);
}

}  // namespace
}  // namespace coop::amcl
