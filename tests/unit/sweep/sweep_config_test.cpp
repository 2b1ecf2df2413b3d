#include "sweep/sweep_config.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/config/config.hpp"

namespace coop::sweep {
namespace {

SweepConfig parse(const std::string& yaml) {
  return config::Document::parse(yaml, "x.yaml").read<SweepConfig>();
}

constexpr const char* kGrid = R"(
launch: collect.yaml
settings: [dwa.mode=paper]
seeds: 2
first_seed: 5
grid:
  - {key: dwa.critic.alpha, name: alpha, values: [0.03, 0.040]}
  - {key: map, values: [a.yaml, b.yaml, c.yaml]}
)";

TEST(SweepConfig, the_last_axis_turns_fastest_then_the_seed) {
  const SweepConfig config = parse(kGrid);
  EXPECT_EQ(count_points(config), 6U);
  const std::vector<sweep::Run> runs = plan_runs(config);
  ASSERT_EQ(runs.size(), 12U);
  EXPECT_EQ(runs[0].number, 1);
  EXPECT_EQ(runs[0].seed, 5);
  EXPECT_EQ(runs[1].seed, 6);
  EXPECT_EQ(runs[2].values, (std::vector<std::string>{"0.03", "b.yaml"}));
  EXPECT_EQ(runs[11].values, (std::vector<std::string>{"0.040", "c.yaml"}));
  EXPECT_EQ(runs[11].point, 5U);
  EXPECT_EQ(runs[11].settings,
            (std::vector<std::string>{"dwa.mode=paper", "dwa.critic.alpha=0.040", "map=c.yaml"}));
  EXPECT_EQ(runs[11].folder_name(), "0012");
}

TEST(SweepConfig, without_a_grid_there_is_one_point) {
  EXPECT_EQ(plan_runs(parse("{launch: a.yaml, seeds: 3}")).size(), 3U);
}

TEST(SweepConfig, runs_that_differ_in_anything_have_different_identities) {
  const SweepConfig config = parse(kGrid);
  const std::vector<sweep::Run> runs = plan_runs(config);
  for (std::size_t i = 1; i < runs.size(); ++i) {
    EXPECT_NE(runs[i].identity(config), runs[0].identity(config));
  }
  SweepConfig other = config;
  other.launch = "other.yaml";
  EXPECT_NE(runs[0].identity(other), runs[0].identity(config));
}

TEST(SweepConfig, what_cannot_work_is_refused) {
  EXPECT_THROW(parse("{seeds: 3}"), config::Error);
  EXPECT_THROW(parse("{launch: a, grid: [{key: k, values: []}]}"), config::Error);
  EXPECT_THROW(parse("{launch: a, grid: [{values: [1]}]}"), config::Error);
  EXPECT_THROW(parse("{launch: a, settings: [dwa]}"), config::Error);
  EXPECT_THROW(parse("{launch: a, figures: [{name: a/b, column: c}]}"), config::Error);
  EXPECT_THROW(parse("{launch: a, gird: []}"), config::Error);
}

TEST(SweepConfig, the_sweeps_that_come_with_coop_are_whole) {
  const std::filesystem::path root = COOP_SOURCE_DIR;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "config/sweeps")) {
    const auto sweep = config::Document::load(entry.path()).read<SweepConfig>();
    EXPECT_TRUE(std::filesystem::exists(root / sweep.launch)) << entry.path();
    EXPECT_GE(sweep.seeds, 20) << entry.path();
    EXPECT_FALSE(sweep.figures.empty()) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3);
}

}  // namespace
}  // namespace coop::sweep
