#include "experiments/navigation/closed_loop.hpp"

#include <gtest/gtest.h>

#include "support/sanitizer.hpp"

namespace coop::test {
namespace {

constexpr std::uint64_t kOneRun = 3;

/// The short version of tests/experiments/navigation: eggs drawn with fixed seeds, one run each.
class ClosedLoop : public testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    if (kThreadSanitizer && GetParam() != kOneRun) {
      GTEST_SKIP() << "not run: one thread, and minutes under ThreadSanitizer";
    }
  }
  static RunResult run(const ClosedLoopConfig& config, std::uint64_t seed) {
    const OccupancyGrid house = make_duck_house();
    const TaskSource tasks(house, {});
    RandomStream random(seed, "task");
    return run_closed_loop(config, house, tasks.draw(random), seed);
  }
};

TEST_P(ClosedLoop, BringsTheEggIntoReachWithoutACollision) {
  const RunResult result = run({}, GetParam());
  EXPECT_TRUE(result.success) << result.failure << ", egg at " << result.egg_in_base.transpose();
  EXPECT_EQ(result.collisions, 0);
  EXPECT_FALSE(result.ran_over_egg);
  EXPECT_LT(result.time, 180.0);
}

TEST_P(ClosedLoop, DoesSoWithNoisyLocalisationAndARefreshedGoal) {
  ClosedLoopConfig config;
  config.position_noise = 0.02;
  config.heading_noise = 0.01;
  config.range_noise = 0.01;
  config.goal_refresh_period = 1.0;
  config.goal_refresh_noise = 0.01;
  const RunResult result = run(config, GetParam());
  EXPECT_TRUE(result.success) << result.failure << ", egg at " << result.egg_in_base.transpose();
  EXPECT_EQ(result.collisions, 0);
}

// A long way round, an egg in a corner, a start in a corner, tight beside posts, egg behind the
// robot.
INSTANTIATE_TEST_SUITE_P(Seeds, ClosedLoop, testing::Values(kOneRun, 4, 51, 28, 38));

TEST(ClosedLoopReproducibility, OneSeedGivesOneRun) {
  if (kThreadSanitizer) GTEST_SKIP() << "not run: one thread, and minutes under ThreadSanitizer";
  const OccupancyGrid house = make_duck_house();
  const TaskSource tasks(house, {});
  ClosedLoopConfig config;
  config.position_noise = 0.02;
  config.range_noise = 0.01;
  std::vector<RunResult> results;
  for (int i = 0; i < 2; ++i) {
    RandomStream random(38, "task");
    results.push_back(run_closed_loop(config, house, tasks.draw(random), 38));
  }
  EXPECT_EQ(results[0].time, results[1].time);
  EXPECT_EQ(results[0].driven, results[1].driven);
  EXPECT_EQ(results[0].egg_in_base, results[1].egg_in_base);
}

}  // namespace
}  // namespace coop::test
