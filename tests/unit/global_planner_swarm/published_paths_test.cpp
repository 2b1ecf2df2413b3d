// The paper's maps and the paths it prints; the copy of its figures in the tree against the shared
// data set.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "experiments/casma/stages.hpp"
#include "global_planner/swarm/four_way.hpp"
#include "support/shared_data.hpp"

namespace coop::casma {
namespace {

Paper paper() {
  return load_paper(std::string(COOP_SOURCE_DIR) + "/tests/experiments/casma/paper.yaml");
}

Grid<Cost> pen_of(const Paper& all, std::size_t map) {
  return pen_with(all.width, all.height, all.maps.at(map).pig_squares());
}

const PublishedPath& published(const PaperMap& map, const std::string& name) {
  return std::ranges::find(map.published, name, &config::Named<PublishedPath>::name)->value;
}

PathCheck check(std::size_t map, const std::string& name) {
  const Paper all = paper();
  const PaperMap& place = all.maps.at(map);
  return check_path(published(place, name).cells(), pen_of(all, map), place.start_cell(),
                    place.goal_cell());
}

TEST(PaperMaps, ShortestPathsHave63And65And56Cells) {
  const Paper all = paper();
  ASSERT_EQ(all.maps.size(), 3U);
  const std::vector<int> expected{63, 65, 56};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const PaperMap& map = all.maps[i];
    EXPECT_EQ(fewest_cells(pen_of(all, i), map.start_cell(), map.goal_cell()), expected[i]);
    // As many as in an empty pen: the pigs cost no step.
    EXPECT_EQ(expected[i], global_planner::swarm::manhattan(map.start_cell(), map.goal_cell()) + 1);
  }
}

TEST(PublishedPaths, OfCasmaAndPsoTouchNoPig) {
  for (std::size_t map = 0; map < 3; ++map) {
    EXPECT_TRUE(check(map, "CASMA").sound());
    EXPECT_TRUE(check(map, "PSO").sound());
  }
}

TEST(PublishedPaths, OfAcoGoThroughPigsOnEveryMap) {
  EXPECT_EQ(check(0, "ACO").pig_cells, 9);
  EXPECT_EQ(check(1, "ACO").pig_cells, 4);
  EXPECT_EQ(check(2, "ACO").pig_cells, 2);
}

TEST(PublishedPaths, OfWpaMissTheGoalOnceAndGoThroughAPigOnce) {
  EXPECT_FALSE(check(0, "WPA").at_goal);
  EXPECT_EQ(check(1, "WPA").pig_cells, 6);
  EXPECT_TRUE(check(2, "WPA").sound());
}

TEST(PublishedPaths, OfFaRepeatTheirLastCell) {
  for (std::size_t map = 0; map < 3; ++map) EXPECT_EQ(check(map, "FA").repeats, 1);
}

TEST(PaperData, EqualsTheSharedDataSet) {
  const auto file = test::shared_data("casma/table7.yaml");
  if (!file) GTEST_SKIP() << "not run: the shared data set is absent";
  const YAML::Node shared = YAML::LoadFile(*file);
  const Paper all = paper();
  EXPECT_EQ(shared["grid"]["width"].as<int>(), all.width);
  EXPECT_EQ(shared["grid"]["height"].as<int>(), all.height);
  ASSERT_EQ(shared["maps"].size(), all.maps.size());
  using Numbers = std::vector<double>;
  for (std::size_t i = 0; i < all.maps.size(); ++i) {
    const YAML::Node map = shared["maps"][i];
    EXPECT_EQ(map["start"].as<Numbers>(), all.maps[i].start);
    EXPECT_EQ(map["goal"].as<Numbers>(), all.maps[i].goal);
    Numbers pigs;
    for (const auto& pig : map["pigs"]) {
      for (const double number : pig.as<Numbers>()) pigs.push_back(number);
    }
    EXPECT_EQ(pigs, all.maps[i].pigs);
    ASSERT_EQ(map["published"].size(), all.maps[i].published.size());
    for (const auto& path : all.maps[i].published) {
      const YAML::Node other = map["published"][path.name];
      EXPECT_EQ(other["steps"].as<int>(), path.value.steps);
      EXPECT_EQ(other["time_ms"].as<double>(), path.value.time_ms);
      EXPECT_EQ(other["x"].as<Numbers>(), path.value.x);
      EXPECT_EQ(other["y"].as<Numbers>(), path.value.y);
    }
  }
}

}  // namespace
}  // namespace coop::casma
