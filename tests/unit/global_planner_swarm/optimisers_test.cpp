#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "global_planner/swarm/ant_sampler.hpp"
#include "global_planner/swarm/fireflies.hpp"
#include "global_planner/swarm/particle_swarm.hpp"
#include "global_planner/swarm/slime_optimiser.hpp"
#include "global_planner/swarm/wolf_pack.hpp"

namespace coop::global_planner::swarm {
namespace {

/// (x - 3)^2 + (y + 1)^2 over [-10, 10]^2; remembers whether it was ever asked outside.
class Bowl final : public Objective {
 public:
  [[nodiscard]] std::span<const double> lower() const override { return kLower; }
  [[nodiscard]] std::span<const double> upper() const override { return kUpper; }
  [[nodiscard]] double operator()(std::span<const double> x) override {
    for (std::size_t d = 0; d < 2; ++d) {
      if (!(x[d] >= kLower[d] && x[d] <= kUpper[d])) left_the_box = true;
    }
    ++calls;
    return (x[0] - 3.0) * (x[0] - 3.0) + (x[1] + 1.0) * (x[1] + 1.0);
  }
  bool left_the_box = false;
  int calls = 0;

 private:
  static constexpr std::array<double, 2> kLower{-10.0, -10.0};
  static constexpr std::array<double, 2> kUpper{10.0, 10.0};
};

/// Runs 100 iterations of 30 individuals and checks what holds for every swarm.
template <class Swarm, class Config>
double lowest_found(Config config) {
  config.swarm = {.population = 30, .iterations = 100};
  Bowl bowl;
  RandomStream random(4, "optimisers_test");
  std::vector<double> course;
  const Minimum found = Swarm(config).minimise(bowl, random, &course);
  EXPECT_FALSE(bowl.left_the_box);
  EXPECT_EQ(course.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(course, std::greater{}));
  EXPECT_DOUBLE_EQ(course.back(), found.value);
  EXPECT_DOUBLE_EQ(bowl(found.place), found.value);
  RandomStream again(4, "optimisers_test");
  EXPECT_EQ(Swarm(config).minimise(bowl, again, nullptr).place, found.place);
  return found.value;
}

TEST(ParticleSwarm, FindsTheBottomOfABowl) {
  EXPECT_LT(lowest_found<ParticleSwarm>(ParticleSwarmConfig{}), 1e-6);
}

TEST(ParticleSwarm, WithTableEightsInertiaIsWorseByFar) {
  ParticleSwarmConfig config;
  config.first_inertia = config.last_inertia = 5.0;
  EXPECT_GT(lowest_found<ParticleSwarm>(config), 1e-4);
}

TEST(WolfPack, FindsTheBottomOfABowl) {
  EXPECT_LT(lowest_found<WolfPack>(WolfPackConfig{}), 1e-3);
}

TEST(Fireflies, FindTheBottomOfABowl) {
  EXPECT_LT(lowest_found<Fireflies>(FirefliesConfig{}), 1e-1);
}

TEST(AntSampler, FindsTheLevelsNearestToTheBottom) {
  // Levels are 20/399 apart: the nearest lie within 0.0251 of the bottom along each dimension.
  EXPECT_LT(lowest_found<AntSampler>(AntSamplerConfig{}), 4.0 * 2.0 * 0.0251 * 0.0251);
}

TEST(SlimeOptimiser, FindsTheBottomOfABowl) {
  EXPECT_LT(lowest_found<SlimeOptimiser>(SlimeOptimiserConfig{}), 1.0);
}

TEST(SlimeOptimiser, ToTheLetterIsNoBetterThanItsFirstScatter) {
  SlimeOptimiserConfig config;
  config.as_printed = true;
  config.swarm = {.population = 30, .iterations = 100};
  Bowl bowl;
  RandomStream random(4, "optimisers_test");
  std::vector<double> course;
  (void)SlimeOptimiser(config).minimise(bowl, random, &course);
  EXPECT_DOUBLE_EQ(course.front(), course.back());
}

}  // namespace
}  // namespace coop::global_planner::swarm
