// The CASMA paper's experiment in short: one seed on the maps, a few trials with moving pigs.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "core/csv.hpp"
#include "experiments/casma/report.hpp"
#include "support/temporary_folder.hpp"

namespace coop::casma {
namespace {

Paper paper() {
  return load_paper(std::string(COOP_SOURCE_DIR) + "/tests/experiments/casma/paper.yaml");
}

std::size_t place_of(const std::string& name) {
  const std::vector<Contender> all = contenders();
  return static_cast<std::size_t>(std::ranges::find(all, name, &Contender::name) - all.begin());
}

TEST(CasmaExperiment, BestIsOptimalOnAllMapsAndTheReportSaysSo) {
  StageOptions options;
  options.seeds = 1;
  options.first_seed = 5;
  Findings findings{paper(), options, run_rosenbrock(options), {}, {}, {}};
  findings.plans = run_maps(findings.paper, options);
  findings.pilot = run_pilot(findings.paper, options);
  for (std::size_t map = 0; map < 3; ++map) {
    for (const char* name : {"CASMA best", "A*", "Dijkstra"}) {
      EXPECT_EQ(summarise(findings, map, place_of(name)).optimal, 1) << name;
    }
    EXPECT_EQ(summarise(findings, map, place_of("CASMA printed")).sound, 0);
    EXPECT_EQ(summarise(findings, map, place_of("ACO")).sound, 1);
  }
  for (const PilotPlan& plan : findings.pilot) EXPECT_EQ(plan.steps, plan.fewest);
  const test::TemporaryFolder folder;
  write_report(folder.path(), findings);
  const CsvTable table = parse_csv(as_csv(plans_table(findings)));
  EXPECT_EQ(table.rows.size(), 3 * contenders().size());
  for (const char* file : {"report.html", "table7.csv", "plans.csv", "figure7_map1.svg"}) {
    EXPECT_TRUE(std::filesystem::file_size(folder.path() / file) > 100) << file;
  }
}

TEST(CasmaExperiment, MovingPigsNeverStandOnTheRobotAndItArrives) {
  const Paper all = paper();
  const std::vector<Contender> planners = moving_contenders();
  for (const std::size_t planner : {std::size_t{0}, std::size_t{2}, std::size_t{3}}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto made = planners[planner].make(seed);
      const MovingRun run = run_moving_trial(all, seed % 3, *made, seed);
      EXPECT_TRUE(run.arrived) << planners[planner].name << ", seed " << seed;
      EXPECT_EQ(run.touched, 0);
      EXPECT_EQ(run.steps + run.waits, run.plans);
    }
  }
}

TEST(CasmaExperiment, TheSameSeedGivesTheSameTrial) {
  const Paper all = paper();
  const auto trial = [&] {
    const auto planner = moving_contenders().front().make(7);
    return run_moving_trial(all, 1, *planner, 7);
  };
  EXPECT_EQ(trial().steps, trial().steps);
  EXPECT_EQ(trial().waits, trial().waits);
}

TEST(CasmaExperiment, EndsWhenItIsToldTo) {
  const std::atomic<bool> stop{true};
  StageOptions options;
  options.stop = &stop;
  int worked = 0;
  run_all("stage", 1000, options, [&](std::size_t) { ++worked; });
  EXPECT_EQ(worked, 0);
}

TEST(CasmaExperiment, PassesOnWhatAWorkerThrows) {
  StageOptions options;
  options.jobs = 2;
  EXPECT_THROW(run_all("stage", 10, options,
                       [](std::size_t i) {
                         if (i == 3) throw std::runtime_error("three");
                       }),
               std::runtime_error);
}

TEST(Pigs, StopBeforeRobotFenceAndOneAnother) {
  // A pen of one row: two pigs of one cell and the robot between them.
  std::vector<Pig> pigs{{{0, 0}, 1}, {{2, 0}, 1}};
  RandomStream random(3, "pigs");
  for (int i = 0; i < 1000; ++i) {
    walk(pigs, 3, 1, {1, 0}, 3, random);
    ASSERT_EQ(pigs[0].middle, (Cell{0, 0}));
    ASSERT_EQ(pigs[1].middle, (Cell{2, 0}));
  }
}

TEST(Pigs, CoverTheirSquare) {
  const Grid<Cost> pen = pen_with(5, 5, {{{2, 2}, 3}});
  EXPECT_EQ(std::ranges::count(pen.cells, kLethalCost), 9);
  EXPECT_EQ((pen[{1, 3}]), kLethalCost);
  EXPECT_EQ((pen[{0, 2}]), kFreeCost);
}

TEST(CheckPath, NamesEachFault) {
  const Grid<Cost> pen = pen_with(5, 1, {{{2, 0}, 1}});
  const PathCheck check = check_path({{0, 0}, {0, 0}, {2, 0}, {3, 0}}, pen, {0, 0}, {4, 0});
  EXPECT_EQ(check.pig_cells, 1);
  EXPECT_EQ(check.jumps, 1);
  EXPECT_EQ(check.repeats, 1);
  EXPECT_TRUE(check.at_start);
  EXPECT_FALSE(check.at_goal);
  EXPECT_FALSE(check.sound());
}

}  // namespace
}  // namespace coop::casma
