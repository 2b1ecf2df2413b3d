#include "slam/resampling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.hpp"

namespace coop::slam {
namespace {

using testing::ElementsAre;

TEST(Weights, AreProportionalToTheExponentialsAndSumToOne) {
  const std::vector<double> logs{std::log(1.0), std::log(3.0)};
  const auto weights = normalized_weights(logs);
  EXPECT_NEAR(weights[0], 0.25, 1e-15);
  EXPECT_NEAR(weights[1], 0.75, 1e-15);
}

TEST(Weights, SurviveLogarithmsThatWouldOverOrUnderflow) {
  const std::vector<double> logs{-5000.0, -5000.0, -9000.0};
  const auto weights = normalized_weights(logs);
  EXPECT_NEAR(weights[0], 0.5, 1e-15);
  EXPECT_EQ(weights[2], 0.0);
  const std::vector<double> large{5000.0, 5000.0};
  EXPECT_NEAR(normalized_weights(large)[1], 0.5, 1e-15);
}

TEST(EffectiveCount, IsTheCountWhereAllAreAlikeAndOneWhereOneHasAll) {
  EXPECT_NEAR(effective_count(std::vector<double>(8, 0.125)), 8.0, 1e-12);
  EXPECT_NEAR(effective_count(std::vector<double>{0.0, 1.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(effective_count(std::vector<double>{0.5, 0.5, 0.0, 0.0}), 2.0, 1e-12);
}

TEST(LowVarianceResample, EqualWeightsKeepEveryParticleOnce) {
  for (const double offset : {0.0, 0.3, 0.999}) {
    EXPECT_THAT(low_variance_resample(std::vector<double>(4, 0.25), offset),
                ElementsAre(0, 1, 2, 3));
  }
}

TEST(LowVarianceResample, CopiesByTheCombOverCumulativeWeights) {
  // Teeth at 0.125, 0.375, 0.625, 0.875; cumulative weights 0.1, 0.7, 0.8, 1.
  const std::vector<double> weights{0.1, 0.6, 0.1, 0.2};
  EXPECT_THAT(low_variance_resample(weights, 0.5), ElementsAre(1, 1, 1, 3));
  // Teeth at 0, 0.25, 0.5, 0.75.
  EXPECT_THAT(low_variance_resample(weights, 0.0), ElementsAre(0, 1, 1, 2));
}

TEST(LowVarianceResample, NumberOfCopiesIsTheShareRoundedDownOrUp) {
  RandomStream random(3, "resampling test");
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> logs(30);
    for (double& log : logs) log = random.normal(0.0, 2.0);
    const auto weights = normalized_weights(logs);
    const auto chosen = low_variance_resample(weights, random.uniform());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const auto copies = static_cast<double>(std::ranges::count(chosen, i));
      const double share = 30.0 * weights[i];
      EXPECT_GE(copies, std::floor(share - 1e-9));
      EXPECT_LE(copies, std::ceil(share + 1e-9));
    }
  }
}

TEST(LowVarianceResample, RoundingInTheSumNeverReachesBeyondTheLastParticle) {
  const std::vector<double> weights{0.5, 0.4999999999};
  EXPECT_THAT(low_variance_resample(weights, 0.99999999999), ElementsAre(0, 1));
}

}  // namespace
}  // namespace coop::slam
