#include "sequencer/path_costs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "sequencer/tour_problem.hpp"

namespace coop::sequencer {
namespace {

/// 10 m x 6 m of free floor with a wall across, open on one side only; 0.1 m a cell.
class PathCostsTest : public ::testing::Test {
 protected:
  PathCostsTest() : map_({.width = 100, .height = 60, .resolution = 0.1, .origin = {0, 0}}, 0) {
    for (int y = 0; y < 50; ++y) map_[{50, y}] = 100;
    map_[{80, 10}] = 100;  // an egg is an obstacle itself
    costs_.set_costmap(map_);
  }
  OccupancyGrid map_;
  PathCosts costs_{Footprint({{-0.2, -0.2}, {0.8, -0.2}, {0.8, 0.2}, {-0.2, 0.2}}), {}};
};

TEST_F(PathCostsTest, AStraightWayCostsItsLength) {
  const auto cost = costs_.pose_cost({1.05, 1.05, 0}, {3.05, 1.05, 0});
  ASSERT_TRUE(cost);
  EXPECT_NEAR(*cost, 2.0, 1e-6);
}

TEST_F(PathCostsTest, AroundTheWallIsFartherThanThroughIt) {
  const CostMatrix matrix = costs_.matrix({4.05, 1.05, 0}, {{6.05, 1.05}});
  EXPECT_GT(matrix.at(0, 1), 8.0);
  EXPECT_TRUE(std::isfinite(matrix.at(0, 1)));
  EXPECT_NEAR(matrix.at(0, 1), matrix.at(1, 0), 1e-3);
}

TEST_F(PathCostsTest, AnEggInItsOwnObstacleCellCanBeDrivenTo) {
  const CostMatrix matrix = costs_.matrix({7.05, 1.05, 0}, {{8.05, 1.05}});
  EXPECT_NEAR(matrix.at(0, 1), 0.9, 0.15);
}

TEST_F(PathCostsTest, ThereAndBackCostTheSameButForRounding) {
  for (int x = 10; x < 40; ++x) {
    for (int y = 5; y < 55; ++y) map_[{x, y}] = static_cast<std::int8_t>((x * 7 + y * 13) % 98);
  }
  costs_.set_costmap(map_);
  RandomStream random(1, "eggs");
  std::vector<Eigen::Vector2d> eggs;
  for (int i = 0; i < 30; ++i) {
    eggs.emplace_back(random.uniform(0.5, 9.5), random.uniform(0.5, 5.5));
  }
  const CostMatrix matrix = costs_.matrix({7.05, 1.05, 0}, eggs);
  EXPECT_TRUE(is_symmetric(matrix));
}

TEST_F(PathCostsTest, APlaceThatIsNoPlaceHasNoWay) {
  const CostMatrix matrix = costs_.matrix({7.05, 1.05, 0}, {{std::nan(""), 1}, {8, 2}});
  EXPECT_FALSE(std::isfinite(matrix.at(0, 1)));
  EXPECT_TRUE(std::isfinite(matrix.at(0, 2)));
}

TEST_F(PathCostsTest, WhereTheFootprintDoesNotFitThereIsNoCost) {
  EXPECT_FALSE(costs_.pose_cost({1, 1, 0}, {4.4, 1, 0})) << "the nose is in the wall";
  EXPECT_TRUE(costs_.pose_cost({1, 1, 0}, {4.4, 1, std::numbers::pi}));
}

}  // namespace
}  // namespace coop::sequencer
