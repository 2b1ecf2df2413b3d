#include "demo/figures.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/image/picture_file.hpp"
#include "demo/picture.hpp"
#include "demo/report.hpp"
#include "support/temporary_folder.hpp"

namespace coop::demo {
namespace {

/// Along x for 2 m in 4 s, believed 0.1 m to the left; one egg picked, one failed.
Record sample_record() {
  Record record;
  for (int i = 0; i <= 4; ++i) {
    const double x = 0.5 * i;
    record.track.push_back({time_from_seconds(100 + i), {x, 0, 0}, {x, 0.1, 0.02}});
  }
  record.map = OccupancyGrid({.width = 60, .height = 40, .resolution = 0.1, .origin = {-2, -2}}, 0);
  record.costmap = record.map;
  record.costmap[{10, 10}] = 100;
  record.costmap[{11, 10}] = 99;
  record.targets = {{"egg1", {1, 1}, "picked", 1, ""}, {"egg2", {2, 1}, "failed", 3, "<no path>"}};
  record.order = {"egg2", "egg1"};
  record.targets_in_world = 2;
  record.targets_taken = 1;
  record.mission_state = "done";
  return record;
}

Record successful_record() {
  Record record = sample_record();
  record.targets[1].state = "picked";
  record.targets_taken = 2;
  return record;
}

TEST(FiguresTest, TimeDistanceAndErrorsAreThoseOfTheTrack) {
  const Figures figures = compute_figures(sample_record());
  EXPECT_DOUBLE_EQ(figures.duration, 4.0);
  EXPECT_DOUBLE_EQ(figures.distance_driven, 2.0);
  EXPECT_DOUBLE_EQ(figures.mean_speed, 0.5);
  EXPECT_NEAR(figures.position_error.mean, 0.1, 1e-12);
  EXPECT_NEAR(figures.position_error.max, 0.1, 1e-12);
  EXPECT_NEAR(figures.heading_error.p95, 0.02, 1e-12);
  EXPECT_EQ(figures.targets_done, 1);
  EXPECT_EQ(figures.targets_failed, 1);
}

TEST(FiguresTest, AnEmptyRecordHasNoFiguresAndIsNoSuccess) {
  EXPECT_DOUBLE_EQ(compute_figures({}).duration, 0.0);
  EXPECT_FALSE(is_success({}));
}

TEST(FiguresTest, SuccessNeedsAllEggsInMissionAndWorldAndNoCollision) {
  EXPECT_FALSE(is_success(sample_record()));
  EXPECT_TRUE(is_success(successful_record()));
  Record bumped = successful_record();
  bumped.collisions = 1;
  EXPECT_FALSE(is_success(bumped));
  Record miscounted = successful_record();
  miscounted.targets_taken = 1;
  EXPECT_FALSE(is_success(miscounted));
  Record unfinished = successful_record();
  unfinished.mission_state = "driving";
  EXPECT_FALSE(is_success(unfinished));
}

TEST(PictureTest, ObstaclesArePurpleAndInscribedCellsLightBlue) {
  const cv::Mat image = draw_run(sample_record());
  // Cell (10, 10) of 40 rows, 8 pixels a cell, y upwards.
  EXPECT_EQ(image.at<cv::Vec3b>((40 - 10) * 8 - 4, 10 * 8 + 4), cv::Vec3b(160, 32, 128));
  EXPECT_EQ(image.at<cv::Vec3b>((40 - 10) * 8 - 4, 11 * 8 + 4), cv::Vec3b(235, 206, 135));
}

TEST(ReportTest, TheFolderHoldsPageFiguresAndPicturesAndTextIsEscaped) {
  const test::TemporaryFolder folder;
  write_report(folder.path(), sample_record(), sample_record(),
               {.seed = 7, .wall_seconds = 1, .version = "Coop"});
  const std::string page = read_file(folder.path() / "report.html");
  EXPECT_NE(page.find("1 of 2 eggs collected"), std::string::npos);
  EXPECT_NE(page.find("&lt;no path&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<no path>"), std::string::npos);
  const auto figures = nlohmann::json::parse(read_file(folder.path() / "figures.json"));
  EXPECT_EQ(figures["seed"], 7);
  EXPECT_FALSE(figures["success"]);
  EXPECT_EQ(figures["collection"]["distance_m"], 2.0);
  EXPECT_TRUE(read_picture(folder.path() / "run.png"));
}

}  // namespace
}  // namespace coop::demo
