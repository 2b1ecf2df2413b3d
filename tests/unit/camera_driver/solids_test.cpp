#include "camera_driver/solids.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/world/shapes.hpp"

namespace coop::camera_driver {
namespace {

const EggShape kEggAlongX{{1.0, 0.0, world::kEggHalfWidth}, 0.0};

TEST(EggSurface, is_half_a_width_above_its_centre_seen_from_above) {
  const EggSurface egg(kEggAlongX, {1.0, 0.0, 1.0});
  const auto hit = egg.cast({0, 0, -1});
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->depth, 1.0 - 2.0 * world::kEggHalfWidth, 1e-12);
  EXPECT_TRUE(hit->normal.isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(EggSurface, is_half_a_length_before_its_centre_along_its_axis_and_half_a_width_across) {
  const Eigen::Vector3d level(0.0, 0.0, world::kEggHalfWidth);
  const auto along = EggSurface(kEggAlongX, level).cast({1, 0, 0});
  ASSERT_TRUE(along.has_value());
  EXPECT_NEAR(along->depth, 1.0 - world::kEggHalfLength, 1e-12);
  const EggShape turned{kEggAlongX.center, 0.5 * std::numbers::pi};
  const auto across = EggSurface(turned, level).cast({1, 0, 0});
  ASSERT_TRUE(across.has_value());
  EXPECT_NEAR(across->depth, 1.0 - world::kEggHalfWidth, 1e-12);
}

TEST(EggSurface, depth_counts_lengths_of_the_direction) {
  const EggSurface egg(kEggAlongX, {1.0, 0.0, 1.0});
  EXPECT_NEAR(egg.cast({0, 0, -2})->depth, 0.5 - world::kEggHalfWidth, 1e-12);
}

TEST(EggSurface, is_missed_beside_it_and_behind_the_ray) {
  const EggSurface egg(kEggAlongX, {1.0, 0.0, 1.0});
  EXPECT_FALSE(egg.cast({0.04, 0, -1}).has_value());
  EXPECT_FALSE(egg.cast({0, 0, 1}).has_value());
}

TEST(Cylinder, is_hit_on_its_side_and_on_its_top) {
  const Cylinder post{{2.0, 0.0}, 0.5, 0.4};
  const auto side = post.cast({0, 0, 0.2}, {1, 0, 0});
  ASSERT_TRUE(side.has_value());
  EXPECT_NEAR(side->depth, 1.5, 1e-12);
  EXPECT_TRUE(side->normal.isApprox(Eigen::Vector3d(-1, 0, 0)));
  const auto top = post.cast({2.2, 0, 1.0}, {0, 0, -1});
  ASSERT_TRUE(top.has_value());
  EXPECT_NEAR(top->depth, 0.6, 1e-12);
  EXPECT_TRUE(top->normal.isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(Cylinder, is_missed_above_and_beside_it) {
  const Cylinder post{{2.0, 0.0}, 0.5, 0.4};
  EXPECT_FALSE(post.cast({0, 0, 0.5}, {1, 0, 0}).has_value());
  EXPECT_FALSE(post.cast({0, 0.6, 0.2}, {1, 0, 0}).has_value());
  EXPECT_FALSE(post.cast({4, 0, 0.2}, {1, 0, 0}).has_value());
}

}  // namespace
}  // namespace coop::camera_driver
