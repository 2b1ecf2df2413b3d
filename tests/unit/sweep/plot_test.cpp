#include "sweep/plot.hpp"

#include <gtest/gtest.h>

namespace coop::sweep {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Plot, ticks_are_round_and_cover_the_range) {
  EXPECT_EQ(ticks_for(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  const auto ticks = ticks_for(0.93, 1.0, 7);
  EXPECT_LE(ticks.front(), 0.93);
  EXPECT_GE(ticks.back(), 1.0);
  EXPECT_NEAR(ticks[1] - ticks[0], 0.01, 1e-12);
}

TEST(Plot, a_line_has_a_gap_where_nothing_was_measured) {
  LinePlot plot;
  plot.places = {"1", "2", "4"};
  plot.series = {{"a", {{1.0, 0.5, 1.5, 3}, {}, {2.0, 1.5, 2.5, 3}}}};
  const std::string svg = draw(plot);
  EXPECT_EQ(count(svg, "<circle"), 2U);
  EXPECT_EQ(count(svg, "M"), 2U);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(Plot, equal_values_and_none_at_all_can_be_drawn) {
  LinePlot plot;
  plot.places = {"a"};
  plot.series = {{"", {{1.0, 1.0, 1.0, 2}}}};
  EXPECT_EQ(draw(plot).find("nan"), std::string::npos);
  plot.series = {{"", {{}}}};
  EXPECT_EQ(draw(plot).find("nan"), std::string::npos);
  EXPECT_EQ(draw(ScatterPlot{}).find("nan"), std::string::npos);
  EXPECT_EQ(draw(BarPlot{}).find("nan"), std::string::npos);
}

TEST(Plot, points_lie_within_the_frame) {
  ScatterPlot plot;
  plot.half_box = {120.0, 100.0};
  plot.groups = {{"hit", "blue", {{0, 0}}}, {"missed <egg>", "red", {{300, -20}}}};
  const std::string svg = draw(plot);
  EXPECT_EQ(count(svg, "<circle"), 4U) << "two points, two in the legend";
  EXPECT_NE(svg.find("missed &lt;egg&gt;"), std::string::npos);
}

}  // namespace
}  // namespace coop::sweep
