#include "amcl/pose_histogram.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace coop::amcl {
namespace {

constexpr double kTenth = std::numbers::pi / 5;  // ten bins a turn

TEST(PoseHistogram, PosesOfOneBinShareIt) {
  PoseHistogram histogram(0.5, kTenth, 100);
  EXPECT_EQ(histogram.add(0.1, 0.1, 0.1, 1.0), 0u);
  EXPECT_EQ(histogram.add(0.4, 0.4, 0.2, 2.0), 0u);
  EXPECT_EQ(histogram.add(0.6, 0.4, 0.2, 4.0), 1u);
  EXPECT_EQ(histogram.add(0.4, 0.4, 1.2, 8.0), 2u);
  EXPECT_EQ(histogram.add(-0.1, 0.4, 0.1, 16.0), 3u) << "negative coordinates round down";
  EXPECT_EQ(histogram.bin_count(), 4u);
  EXPECT_DOUBLE_EQ(histogram.weight(0), 3.0);
  EXPECT_DOUBLE_EQ(histogram.weight(3), 16.0);
}

TEST(PoseHistogram, IsEmptyAfterClear) {
  PoseHistogram histogram(0.5, kTenth, 100);
  for (int round = 0; round < 1000; ++round) {
    histogram.clear();
    EXPECT_EQ(histogram.bin_count(), 0u);
    EXPECT_EQ(histogram.add(round, 0, 0, 1), 0u);
    EXPECT_DOUBLE_EQ(histogram.weight(0), 1.0);
  }
}

TEST(PoseHistogram, HoldsAsManyBinsAsItsCapacity) {
  PoseHistogram histogram(1.0, kTenth, 5000);
  for (int i = 0; i < 5000; ++i) histogram.add(i % 100, i / 100, 0.1, 1.0);
  EXPECT_EQ(histogram.bin_count(), 5000u);
  std::vector<std::uint32_t> labels;
  EXPECT_EQ(histogram.label_components(labels), 1u);
}

TEST(PoseHistogram, ComponentsAreSeparatedByEmptyBins) {
  PoseHistogram histogram(1.0, kTenth, 100);
  const auto a = histogram.add(0.5, 0.5, 0.1, 1);
  const auto b = histogram.add(1.5, 1.5, 0.1, 1);  // touches a at a corner
  const auto c = histogram.add(4.5, 0.5, 0.1, 1);  // apart
  const auto d = histogram.add(0.5, 0.5, 2.0, 1);  // same place, other heading
  std::vector<std::uint32_t> labels;
  EXPECT_EQ(histogram.label_components(labels), 3u);
  EXPECT_EQ(labels[a], labels[b]);
  EXPECT_NE(labels[a], labels[c]);
  EXPECT_NE(labels[a], labels[d]);
}

TEST(PoseHistogram, HeadingsCloseRoundTheTurn) {
  PoseHistogram histogram(1.0, kTenth, 100);
  const auto a = histogram.add(0.5, 0.5, std::numbers::pi - 0.01, 1);
  const auto b = histogram.add(0.5, 0.5, -std::numbers::pi + 0.01, 1);
  EXPECT_NE(a, b);
  std::vector<std::uint32_t> labels;
  EXPECT_EQ(histogram.label_components(labels), 1u);
}

}  // namespace
}  // namespace coop::amcl
