// A small sweep of whole systems: stopped on the way, gone on with, and the same rows from another
// call.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "core/csv.hpp"
#include "system/sweep/tiny_sweep.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;
constexpr auto kLimit = kSweepLimit;

TEST(SweepSystem, GoesOnWhereItWasStoppedAndGivesTheRowsOfOneThatWasNot) {
  const TinySweep tiny;
  const fs::path stopped = tiny.path("stopped");
  auto first = tiny.start(stopped);
  ASSERT_TRUE(wait_until([&] { return fs::exists(stopped / "runs/0001/result.json"); }, kLimit))
      << first->output();
  first->signal(SIGINT);
  const auto status = first->wait(kLimit);
  ASSERT_TRUE(status);
  const auto result = stopped / "runs/0001/result.json";
  const auto made = fs::last_write_time(result);

  auto second = tiny.start(stopped);
  const auto ended = second->wait(kLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 0) << second->output();
  EXPECT_EQ(fs::last_write_time(result), made) << "a finished run is not made again";

  const fs::path whole = tiny.path("whole");
  ASSERT_TRUE(tiny.start(whole)->wait(kLimit));
  const std::string rows = read_file(whole / "all.csv");
  EXPECT_EQ(read_file(stopped / "all.csv"), rows);
  const CsvTable table = parse_csv(rows);
  EXPECT_EQ(table.rows.size(), 10U) << "five eggs in each of two runs";
  EXPECT_TRUE(fs::exists(whole / "report.html"));
}

TEST(SweepSystem, OneRunOfManyIsMadeAloneAndNotMixedWithThoseOfOtherInputs) {
  const TinySweep tiny;
  const fs::path results = tiny.path("results");
  auto task = tiny.start(results, {"--only", "2"});
  const auto ended = task->wait(kLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 0) << task->output();
  EXPECT_TRUE(fs::exists(results / "runs/0002/result.json"));
  EXPECT_FALSE(fs::exists(results / "runs/0001"));
  EXPECT_FALSE(fs::exists(results / "report.html"));

  auto changed = tiny.start(results, {"--set", "dwa.mode=paper"});
  const auto refused = changed->wait(kLimit);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->code, 1);
  EXPECT_EQ(changed->output(),
            "sweep: the results in " + results.string() +
                " are of other inputs (changed: sweep: settings); --restart makes "
                "all of them anew, or name another folder with -o\n");
}

TEST(SweepSystem, ARunDuringWhichAnInputChangedHasNoResult) {
  const TemporaryFolder folder;
  const fs::path launch = folder.path() / "own.yaml";
  const std::string text =
      std::string("include: [") + COOP_SOURCE_DIR + "/config/launch/experiment.yaml]\n";
  write_file_atomically(launch, text);
  const TinySweep tiny(launch.string());
  const fs::path results = tiny.path("results");
  auto task = tiny.start(results, {"--only", "1"});
  ASSERT_TRUE(wait_until([&] { return fs::exists(results / "runs/0001/launcher.log"); }, kLimit));
  write_file_atomically(launch, text + "# edited\n");
  const auto ended = task->wait(kLimit);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->code, 1) << task->output();
  EXPECT_THAT(read_file(results / "runs/0001/result.json"),
              ::testing::HasSubstr("inputs changed while it ran: " + launch.string()));
}

}  // namespace
}  // namespace coop::test
