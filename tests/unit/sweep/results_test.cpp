#include "sweep/results.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include "sweep/report.hpp"

namespace coop::sweep {
namespace {

/// A sweep of two points with two seeds, some of whose runs have left results.
class ResultsTest : public ::testing::Test {
 protected:
  ResultsTest() {
    config_.title = "speed <and> path";
    config_.launch = "a.yaml";
    config_.seeds = 2;
    config_.grid = {{"dwa.speed", "speed", {"0.3", "0.6"}}};
    config_.figures = {{"hit", "", "hit", "share", ""}, {"path", "", "path", "mean", "m"}};
    runs_ = plan_runs(config_);
  }
  void leave(std::size_t run, const std::string& table) {
    write_file_atomically(table_file(folder_.path(), runs_[run]), table);
    RunResult result{true, "", 2.5, runs_[run].identity(config_)};
    write_file_atomically(result_file(folder_.path(), runs_[run]), to_json(result));
  }
  void leave_problem(std::size_t run) {
    RunResult result{false, "died", 1.0, runs_[run].identity(config_)};
    write_file_atomically(result_file(folder_.path(), runs_[run]), to_json(result));
  }
  [[nodiscard]] bool finished(std::size_t run) const {
    return is_finished(folder_.path(), config_, runs_[run]);
  }
  [[nodiscard]] std::vector<FinishedRun> gathered() const {
    return gather(folder_.path(), config_, runs_);
  }

  test::TemporaryFolder folder_;
  SweepConfig config_;
  std::vector<sweep::Run> runs_;
};

TEST_F(ResultsTest, OnlyARunWithItsResultIsFinished) {
  leave(0, "hit,path\n1,2\n");
  leave_problem(1);
  std::filesystem::create_directories(run_folder(folder_.path(), runs_[2]));
  EXPECT_TRUE(finished(0));
  EXPECT_FALSE(finished(1)) << "without success: to be made again";
  EXPECT_FALSE(finished(2)) << "interrupted";
}

TEST_F(ResultsTest, AResultMadeWithOtherSettingsDoesNotCount) {
  leave(0, "hit,path\n1,2\n");
  config_.settings = {"dwa.mode=paper"};
  runs_ = plan_runs(config_);
  EXPECT_FALSE(finished(0));
  EXPECT_TRUE(gathered().empty());
}

TEST_F(ResultsTest, RowsOfAllRunsStandInTheOrderOfTheRuns) {
  leave(2, "hit,path\n0,4\n");
  leave(0, "hit,path\n1,2\n1,3\n");
  leave_problem(1);
  EXPECT_EQ(all_rows(config_, gathered()), "run,speed,hit,path\n1,0.3,1,2\n1,0.3,1,3\n3,0.6,0,4\n");
  EXPECT_EQ(run_rows(config_, gathered()),
            "run,speed,seed,success,wall_seconds,problem\n1,0.3,1,1,2.5,\n2,0.3,2,0,1.0,died\n"
            "3,0.6,1,1,2.5,\n");
}

TEST_F(ResultsTest, AShareCountsRowsAMeanCountsRuns) {
  leave(0, "hit,path\n1,2\n0,4\n1,\n");
  leave(1, "hit,path\n1,5\n");
  const auto shares = estimate(config_, config_.figures[0], gathered());
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_DOUBLE_EQ(shares[0].value, 0.75);
  EXPECT_EQ(shares[0].count, 4U);
  EXPECT_EQ(shares[1].count, 0U);
  const auto means = estimate(config_, config_.figures[1], gathered());
  EXPECT_DOUBLE_EQ(means[0].value, 4.0) << "mean of 3 and 5";
  EXPECT_EQ(means[0].count, 2U);
}

TEST_F(ResultsTest, AColumnThatIsMissingOrNoNumberIsNamed) {
  leave(0, "hit,path\nyes,2\n");
  EXPECT_THROW((void)estimate(config_, config_.figures[0], gathered()), std::runtime_error);
  leave(0, "path\n2\n");
  EXPECT_THROW((void)estimate(config_, config_.figures[0], gathered()), std::runtime_error);
}

TEST_F(ResultsTest, TheReportIsDrawnFromWhatIsThereAndTheTitleIsNoMarkup) {
  leave(0, "hit,path\n1,2\n");
  leave_problem(1);
  const auto pages = render_sweep(config_, runs_, gathered());
  write_pages(folder_.path() / "out", pages);
  const std::string html = read_file(folder_.path() / "out" / "report.html");
  EXPECT_NE(html.find("speed &lt;and&gt; path"), std::string::npos);
  EXPECT_NE(html.find("1 of 4 runs"), std::string::npos);
  EXPECT_NE(html.find("died"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / "figure_hit.svg"));
}

TEST_F(ResultsTest, NothingAtAllStillMakesAReport) {
  EXPECT_FALSE(render_sweep(config_, runs_, gathered()).empty());
}

TEST(RunResult, comes_back_from_its_file) {
  const RunResult result{false, "exit code \"2\"", 1.5, "a\nb"};
  const RunResult back = result_from_json(to_json(result));
  EXPECT_EQ(back.problem, result.problem);
  EXPECT_EQ(back.identity, result.identity);
  EXPECT_THROW((void)result_from_json("{}"), std::runtime_error);
}

}  // namespace
}  // namespace coop::sweep
