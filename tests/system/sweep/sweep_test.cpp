// A small sweep of whole systems: stopped on the way, gone on with, and the same rows from another
// call.
#include <gtest/gtest.h>

#include <csignal>
#include <memory>

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::minutes kLimit{5};

class SweepSystem : public ::testing::Test {
 protected:
  SweepSystem() {
    control_folder();
    // Seconds of a mission: nothing is tried, and every egg is accounted for.
    write_file_atomically(folder_.path() / "tiny.yaml",
                          "title: tiny\n"
                          "launch: config/launch/experiment.yaml\n"
                          "seeds: 1\n"
                          "settings: [referee.time_limit=2]\n"
                          "grid: [{key: sequencer.mission.settle_time, values: [0.5, 0.6]}]\n"
                          "figures: [{name: hit, column: in_range, kind: share}]\n");
  }
  std::unique_ptr<Program> sweep(const fs::path& results,
                                 const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{(folder_.path() / "tiny.yaml").string(), "-o",
                                       results.string(), "--domain", std::to_string(test_domain())};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("sweep", arguments, folder_.path() / "out");
  }
  TemporaryFolder folder_;
};

TEST_F(SweepSystem, GoesOnWhereItWasStoppedAndGivesTheRowsOfOneThatWasNot) {
  const fs::path stopped = folder_.path() / "stopped";
  auto first = sweep(stopped);
  ASSERT_TRUE(wait_until([&] { return fs::exists(stopped / "runs/0001/result.json"); }, kLimit))
      << first->output();
  first->signal(SIGINT);
  const auto status = first->wait(kLimit);
  ASSERT_TRUE(status);
  const auto result = stopped / "runs/0001/result.json";
  const auto made = fs::last_write_time(result);

  auto second = sweep(stopped);
  const auto ended = second->wait(kLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 0) << second->output();
  EXPECT_EQ(fs::last_write_time(result), made) << "a finished run is not made again";

  const fs::path whole = folder_.path() / "whole";
  ASSERT_TRUE(sweep(whole)->wait(kLimit));
  const std::string rows = read_file(whole / "all.csv");
  EXPECT_EQ(read_file(stopped / "all.csv"), rows);
  const CsvTable table = parse_csv(rows);
  EXPECT_EQ(table.rows.size(), 10U) << "five eggs in each of two runs";
  EXPECT_TRUE(fs::exists(whole / "report.html"));
}

TEST_F(SweepSystem, OneRunOfManyIsMadeAloneAndNotMixedWithThoseOfOtherInputs) {
  const fs::path results = folder_.path() / "results";
  auto task = sweep(results, {"--only", "2"});
  const auto ended = task->wait(kLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 0) << task->output();
  EXPECT_TRUE(fs::exists(results / "runs/0002/result.json"));
  EXPECT_FALSE(fs::exists(results / "runs/0001"));
  EXPECT_FALSE(fs::exists(results / "report.html"));

  auto changed = sweep(results, {"--set", "dwa.mode=paper"});
  const auto refused = changed->wait(kLimit);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->code, 1);
  EXPECT_EQ(changed->output(),
            "sweep: the results in " + results.string() +
                " are of other inputs (changed: sweep: settings); --restart makes "
                "all of them anew, or name another folder with -o\n");
}

}  // namespace
}  // namespace coop::test
