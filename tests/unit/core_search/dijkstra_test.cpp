#include "core/search/dijkstra.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <queue>
#include <sstream>
#include <string>
#include <string_view>

#include "core/random.hpp"
#include "support/shared_data.hpp"

namespace coop {
namespace {

constexpr double kSqrt2 = std::numbers::sqrt2;

/// Draws a grid of 1 m cells; the first line is the top row. '.' free, '#' lethal, 'i' inscribed,
/// '?' unknown, a digit d a restricted cell of cost 28 d (9: the highest).
Grid<Cost> draw(const std::vector<std::string_view>& rows) {
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kFreeCost);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      Cost& cost = costs[{x, y}];
      if (c == '#') cost = kLethalCost;
      if (c == 'i') cost = kInscribedCost;
      if (c == '?') cost = kUnknownCost;
      if (c >= '1' && c <= '9') cost = static_cast<Cost>(28 * (c - '0'));
    }
  }
  return costs;
}

TraversalGrid make_grid(const Grid<Cost>& costs, const TraversalConfig& config = {}) {
  TraversalGrid grid(config);
  grid.update(costs);
  return grid;
}

TEST(Dijkstra, TakesDiagonalsInTheOpen) {
  const TraversalGrid grid = make_grid(draw({"....",  //
                                             "....",  //
                                             "...."}));
  const auto path = Dijkstra().plan(grid, {0, 0}, {3, 2});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 1.0 + 2.0 * kSqrt2, 1e-9);
  EXPECT_EQ(path->cells.front(), (Cell{0, 0}));
  EXPECT_EQ(path->cells.back(), (Cell{3, 2}));
  EXPECT_EQ(path->cells.size(), 4U);
}

TEST(Dijkstra, DoesNotCutCorners) {
  const TraversalGrid grid = make_grid(draw({"..",  //
                                             "#."}));
  const auto path = Dijkstra().plan(grid, {0, 1}, {1, 0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 2.0, 1e-9);
}

TEST(Dijkstra, WeighsAStepWithTheMeanOfItsTwoCells) {
  const TraversalGrid grid = make_grid(draw({".9."}), {.restricted_weight = 6.0});
  const auto path = Dijkstra().plan(grid, {0, 0}, {2, 0});
  ASSERT_TRUE(path);
  // Factors 1, 7, 1: two steps of (1 + 7) / 2.
  EXPECT_NEAR(path->cost, 8.0, 1e-9);
}

TEST(Dijkstra, GoesRoundARestrictedZoneWhereThatIsCheaper) {
  const TraversalGrid grid = make_grid(draw({".....",  //
                                             "..9..",  //
                                             "....."}),
                                       {.restricted_weight = 6.0});
  const auto path = Dijkstra().plan(grid, {0, 1}, {4, 1});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 2.0 + 2.0 * kSqrt2, 1e-9);
  for (const Cell cell : path->cells) EXPECT_FALSE(cell == (Cell{2, 1}));
}

TEST(Dijkstra, TellsApartWhyThereIsNoPath) {
  const TraversalGrid grid = make_grid(draw({"..#.",  //
                                             "..#i"}));
  Dijkstra dijkstra;
  EXPECT_EQ(dijkstra.plan(grid, {0, 0}, {3, 1}).error(), SearchFailure::kNoPath);
  EXPECT_EQ(dijkstra.plan(grid, {2, 0}, {0, 1}).error(), SearchFailure::kStartBlocked);
  EXPECT_EQ(dijkstra.plan(grid, {0, 0}, {3, 0}).error(), SearchFailure::kGoalBlocked);
  EXPECT_EQ(dijkstra.plan(grid, {0, 0}, {4, 0}).error(), SearchFailure::kGoalBlocked);
}

TEST(Dijkstra, CrossesUnknownCellsOnlyWhereThatIsAllowed) {
  const Grid<Cost> costs = draw({".?."});
  EXPECT_FALSE(Dijkstra().plan(make_grid(costs), {0, 0}, {2, 0}));
  const auto path = Dijkstra().plan(
      make_grid(costs, {.unknown_weight = 2.0, .allow_unknown = true}), {0, 0}, {2, 0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->cost, 4.0, 1e-9);
}

TEST(TraversalGrid, OpensInscribedCellsAroundAStartAndClosesThemAgain) {
  TraversalGrid grid = make_grid(draw({"ii...i"}));
  EXPECT_FALSE(Dijkstra().plan(grid, {0, 0}, {4, 0}));
  grid.open_around({0, 0}, 1.5);
  EXPECT_TRUE(Dijkstra().plan(grid, {0, 0}, {4, 0}));
  EXPECT_FALSE(Dijkstra().plan(grid, {0, 0}, {5, 0}));
  grid.close();
  EXPECT_FALSE(Dijkstra().plan(grid, {0, 0}, {4, 0}));
}

/// Plain Dijkstra with a heap in doubles, to compare with.
std::vector<double> reference_costs(const TraversalGrid& grid, Cell goal) {
  const GridGeometry& geometry = grid.geometry();
  std::vector<double> cost(geometry.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[geometry.index(goal)] = 0.0;
  open.emplace(0.0, geometry.index(goal));
  while (!open.empty()) {
    const auto [here_cost, index] = open.top();
    open.pop();
    if (here_cost > cost[index]) continue;
    const Cell here = geometry.cell_at(index);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{here.x + dx, here.y + dy};
        if ((dx == 0 && dy == 0) || !grid.passable(next)) continue;
        if (!grid.passable({here.x + dx, here.y}) || !grid.passable({here.x, here.y + dy}))
          continue;
        const double step =
            std::hypot(dx, dy) * 0.5 *
            (grid.factor(grid.padded_index(here)) + grid.factor(grid.padded_index(next)));
        const double candidate = here_cost + step;
        if (candidate >= cost[geometry.index(next)]) continue;
        cost[geometry.index(next)] = candidate;
        open.emplace(candidate, geometry.index(next));
      }
    }
  }
  return cost;
}

TEST(Dijkstra, EqualsAPlainHeapSearchOnRandomWeightedGrids) {
  RandomStream random(11, "dijkstra_test");
  Dijkstra dijkstra;
  for (int trial = 0; trial < 30; ++trial) {
    Grid<Cost> costs({1 + static_cast<int>(random.below(30)),
                      1 + static_cast<int>(random.below(30)),
                      1.0,
                      {0.0, 0.0}},
                     kFreeCost);
    for (Cost& cost : costs.cells) {
      const double u = random.uniform();
      cost = u < 0.2 ? kLethalCost : (u < 0.6 ? static_cast<Cost>(random.below(253)) : kFreeCost);
    }
    const Cell goal = costs.geometry.cell_at(random.below(costs.cells.size()));
    costs[goal] = kFreeCost;
    const TraversalGrid grid = make_grid(costs);
    dijkstra.flood(grid, goal, std::numeric_limits<double>::infinity());
    const std::vector<double> expected = reference_costs(grid, goal);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Cell cell = costs.geometry.cell_at(i);
      if (std::isinf(expected[i])) {
        EXPECT_TRUE(std::isinf(dijkstra.cost_to_goal(cell)));
      } else {
        EXPECT_NEAR(dijkstra.cost_to_goal(cell), expected[i], 1e-4 * (1.0 + expected[i]));
        EXPECT_NEAR(dijkstra.path_from(grid, cell).cost, expected[i], 1e-4 * (1.0 + expected[i]));
      }
    }
  }
}

/// A map of the MovingAI benchmark: '.' and 'G' are free.
Grid<Cost> read_moving_ai_map(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string word;
  int width = 0;
  int height = 0;
  while (file >> word && word != "map") {
    if (word == "height") file >> height;
    if (word == "width") file >> width;
  }
  Grid<Cost> costs({width, height, 1.0, {0.0, 0.0}}, kLethalCost);
  for (int y = 0; y < height; ++y) {
    file >> word;
    for (int x = 0; x < width; ++x) {
      const char c = word[static_cast<std::size_t>(x)];
      if (c == '.' || c == 'G') costs[{x, y}] = kFreeCost;
    }
  }
  return costs;
}

/// The scenario files round to six digits, some to two decimals, and some lengths were summed in
/// single precision.
double tolerance_of(const std::string& number) {
  const std::size_t point = number.find('.');
  const double decimals =
      point == std::string::npos ? 0.0 : static_cast<double>(number.size() - point - 1);
  return 0.5 * std::pow(10.0, -std::max(2.0, decimals)) + 5e-6 * std::stod(number);
}

class MovingAi : public testing::TestWithParam<const char*> {};

TEST_P(MovingAi, PathsHaveThePublishedOptimalLengths) {
  const auto map = test::shared_data(std::string("planning/") + GetParam() + ".map");
  const auto scenarios = test::shared_data(std::string("planning/") + GetParam() + ".map.scen");
  if (!map || !scenarios) GTEST_SKIP() << "not run: shared planning data is absent";
  const TraversalGrid grid = make_grid(read_moving_ai_map(*map));
  std::ifstream file(*scenarios);
  std::string line;
  std::getline(file, line);
  Dijkstra dijkstra;
  int number = 0;
  int compared = 0;
  while (std::getline(file, line)) {
    if (line.empty() || number++ % 40 != 0)
      continue;  // a spread over all lengths keeps the test short
    std::istringstream fields(line);
    std::string bucket, name;
    int width = 0, height = 0;
    Cell start, goal;
    std::string length;
    fields >> bucket >> name >> width >> height >> start.x >> start.y >> goal.x >> goal.y >> length;
    const auto path = dijkstra.plan(grid, start, goal);
    ASSERT_TRUE(path) << line;
    EXPECT_NEAR(path->cost, std::stod(length), tolerance_of(length)) << line;
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

INSTANTIATE_TEST_SUITE_P(Maps, MovingAi,
                         testing::Values("arena", "den312d", "brc202d", "orz900d", "AR0011SR",
                                         "32room_000", "random512-25-0", "maze512-4-0",
                                         "Berlin_0_512", "Boston_0_512"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace coop
