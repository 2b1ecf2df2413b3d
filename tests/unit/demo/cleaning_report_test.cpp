#include "demo/cleaning_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "demo/figures.hpp"
#include "support/temporary_folder.hpp"

namespace coop::demo {
namespace {

using testing::HasSubstr;

/// A pen with two heaps: one was cleaned, the other not.
PenRun sample_run() {
  PenRun run{.pen = 3, .seed = 7, .record = {}};
  Record& record = run.record;
  record.map = OccupancyGrid(
      {.width = 110, .height = 70, .resolution = 0.05, .origin = {-0.25, -0.25}}, kFree);
  for (int i = 0; i < 20; ++i) {
    const Pose2 pose{0.5 + 0.1 * i, 0.5, 0};
    record.track.push_back({time_from_seconds(10 + i), pose, pose});
  }
  record.heaps = {{"a", {1.0, 0.5}, 0.07, world::HeapState::kCleaned},
                  {"b", {3.0, 2.0}, 0.07, world::HeapState::kOnFloor}};
  record.animal_tracks = {{{2.0, 1.0}, {2.2, 1.0}}};
  record.animal_radii = {0.25};
  record.targets = {{"heap1", {1.0, 0.5}, "cleaned", 1, ""},
                    {"heap2", {3.0, 2.0}, "failed", 8, "a pig"}};
  record.order = {"heap1", "heap2"};
  record.targets_in_world = 2;
  record.targets_taken = 1;
  record.mission_state = "done";
  return run;
}

PenRun clean_run() {
  PenRun run = sample_run();
  run.record.heaps[1].state = world::HeapState::kCleaned;
  run.record.targets[1].state = "cleaned";
  run.record.targets_taken = 2;
  return run;
}

TEST(CleaningReport, APenIsCleanWhenMissionAndSimulatorSaySoAndNothingWasTouched) {
  EXPECT_FALSE(is_clean(sample_run().record));
  EXPECT_TRUE(is_clean(clean_run().record));
  Record touched = clean_run().record;
  touched.collisions = 1;
  EXPECT_FALSE(is_clean(touched));
  Record left = clean_run().record;
  left.targets_taken = 1;
  EXPECT_FALSE(is_clean(left));
}

TEST(CleaningReport, ThePicturesShowThePenAndTheHouse) {
  const cv::Mat pen = draw_pen(sample_run().record);
  EXPECT_GT(pen.cols, 900);
  EXPECT_GT(pen.rows, 550);
  const cv::Mat house = draw_house({sample_run(), clean_run()});
  EXPECT_EQ(house.cols, 110 * 3);
}

TEST(CleaningReport, ThePageAndTheFiguresTellOfEveryPen) {
  const std::string page = render_cleaning_html({sample_run(), clean_run()},
                                                {.seed = 7, .wall_seconds = 5, .version = "v"});
  EXPECT_THAT(page, HasSubstr("3 of 4 heaps cleaned, 0 pigs touched"));
  EXPECT_THAT(page, HasSubstr("a pig"));
  const auto figures = nlohmann::json::parse(render_cleaning_json(
      {sample_run(), clean_run()}, {.seed = 7, .wall_seconds = 5, .version = "v"}));
  EXPECT_FALSE(figures["success"]);
  EXPECT_EQ(figures["pens"][0]["pen"], 3);
  EXPECT_EQ(figures["pens"][1]["targets_taken"], 2);
}

TEST(CleaningReport, AllFilesAreWritten) {
  const test::TemporaryFolder folder;
  write_cleaning_report(folder.path(), {clean_run()},
                        {.seed = 1, .wall_seconds = 5, .version = "v"});
  for (const char* file : {"run.png", "house.png", "report.html", "figures.json"}) {
    EXPECT_FALSE(read_file(folder.path() / file).empty()) << file;
  }
}

}  // namespace
}  // namespace coop::demo
