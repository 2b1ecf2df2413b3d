#include "core/costmap/distance_transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace coop {
namespace {

std::vector<std::int32_t> brute_force(const std::vector<std::uint8_t>& sources, int width,
                                      int height, int cap) {
  std::vector<std::int32_t> result(sources.size(), cap * cap);
  const GridGeometry grid{width, height, 1.0, {0.0, 0.0}};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (std::size_t j = 0; j < sources.size(); ++j) {
      if (sources[j] == 0) continue;
      const Cell a = grid.cell_at(i);
      const Cell b = grid.cell_at(j);
      const int squared = (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
      result[i] = std::min(result[i], squared);
    }
  }
  return result;
}

TEST(DistanceTransform, GivesSquaredDistancesThatCanBeCheckedByHand) {
  const std::vector<std::uint8_t> sources{0, 0, 0, 0,  //
                                          0, 1, 0, 0,  //
                                          0, 0, 0, 0};
  std::vector<std::int32_t> squared(12);
  DistanceTransform().run(sources, 4, 3, squared);
  EXPECT_EQ(squared, (std::vector<std::int32_t>{2, 1, 2, 5,  //
                                                1, 0, 1, 4,  //
                                                2, 1, 2, 5}));
}

TEST(DistanceTransform, WithoutAnySourceEveryCellHoldsTheCap) {
  const std::vector<std::uint8_t> sources(6, 0);
  std::vector<std::int32_t> squared(6);
  DistanceTransform().run(sources, 3, 2, squared, 7);
  EXPECT_EQ(squared, std::vector<std::int32_t>(6, 49));
}

TEST(DistanceTransform, WorksOnASingleRowAndASingleColumn) {
  const std::vector<std::uint8_t> sources{0, 0, 1, 0, 0};
  const std::vector<std::int32_t> expected{4, 1, 0, 1, 4};
  std::vector<std::int32_t> squared(5);
  DistanceTransform transform;
  transform.run(sources, 5, 1, squared);
  EXPECT_EQ(squared, expected);
  transform.run(sources, 1, 5, squared);
  EXPECT_EQ(squared, expected);
}

TEST(DistanceTransform, EqualsBruteForceOnRandomGridsWithAndWithoutCap) {
  RandomStream random(7, "distance_transform_test");
  DistanceTransform transform;
  for (int trial = 0; trial < 60; ++trial) {
    const int width = 1 + static_cast<int>(random.below(40));
    const int height = 1 + static_cast<int>(random.below(40));
    const double density = trial % 3 == 0 ? 0.005 : (trial % 3 == 1 ? 0.1 : 0.7);
    std::vector<std::uint8_t> sources(static_cast<std::size_t>(width * height));
    for (auto& cell : sources) cell = random.uniform() < density ? 1 : 0;
    for (const int cap : {1, 3, 11, DistanceTransform::kSmallCap, DistanceTransform::kSmallCap + 1,
                          DistanceTransform::kNoCap}) {
      std::vector<std::int32_t> squared(sources.size(), -1);
      transform.run(sources, width, height, squared, cap);
      EXPECT_EQ(squared, brute_force(sources, width, height, cap))
          << width << " x " << height << ", cap " << cap << ", trial " << trial;
    }
  }
}

TEST(DistanceToOccupied, IsInMetresIgnoresUnknownAndEndsAtTheMaximum) {
  OccupancyGrid map({5, 1, 0.1, {0.0, 0.0}}, kFree);
  map.cells = {kOccupied, 64, kUnknown, kFree, kFree};
  const Grid<float> distance = distance_to_occupied(map, 0.25);
  EXPECT_FLOAT_EQ(distance.cells[0], 0.0F);
  EXPECT_FLOAT_EQ(distance.cells[1], 0.1F);
  EXPECT_FLOAT_EQ(distance.cells[2], 0.2F);
  EXPECT_FLOAT_EQ(distance.cells[3], 0.25F);
  EXPECT_FLOAT_EQ(distance.cells[4], 0.25F);
}

}  // namespace
}  // namespace coop
