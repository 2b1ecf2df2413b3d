#include "sweep/navigation_report.hpp"

#include <gtest/gtest.h>

namespace coop::sweep {
namespace {

constexpr const char* kTable =
    "try,in_range,picked,collisions,cause,arrival_time,distance,deviation_x,deviation_y,"
    "localisation_error,path_length\n"
    "1,1,1,0,,10,0.01,0.01,0,0.03,4\n"
    "1,0,0,1,localisation error,20,0.3,0.3,0,0.31,2\n"
    "2,1,1,0,,30,0.01,0.01,0,0.03,1\n"
    "0,0,0,0,not seen,,,,,,0\n";

TEST(NavigationReport, counts_first_tries_and_names_causes) {
  SweepConfig config;
  config.launch = "a.yaml";
  config.seeds = 2;
  const std::vector<sweep::Run> runs = plan_runs(config);
  std::vector<FinishedRun> finished;
  finished.push_back({runs[0], {true, "", 10.0, ""}, parse_csv(kTable)});
  finished.push_back({runs[1], {false, "died", 10.0, ""}, {}});
  std::vector<Page> pages;
  const std::string html = render_navigation(runs, finished, pages);
  EXPECT_NE(html.find("1 of 3, 33.3 %"), std::string::npos) << html;
  EXPECT_NE(html.find("134 of 150, 89.3 %"), std::string::npos);
  EXPECT_NE(html.find("localisation error"), std::string::npos);
  ASSERT_EQ(pages.size(), 3U);
  EXPECT_EQ(pages[0].name, "table1.csv");
  EXPECT_NE(pages[0].content.find("1,T,F,F,,"), std::string::npos) << pages[0].content;
}

}  // namespace
}  // namespace coop::sweep
