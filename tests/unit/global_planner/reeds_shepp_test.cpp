#include "global_planner/reeds_shepp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace coop::global_planner {
namespace {

TEST(ReedsShepp, DrivesStraightAheadAndStraightBack) {
  const ReedsShepp curves(0.8);
  EXPECT_NEAR(curves.distance({0, 0, 0}, {3, 0, 0}), 3.0, 1e-9);
  EXPECT_NEAR(curves.distance({1, 1, std::numbers::pi / 2}, {1, -1, std::numbers::pi / 2}), 2.0,
              1e-9);
}

TEST(ReedsShepp, QuarterCircleIsOneArc) {
  const ReedsShepp curves(2.0);
  EXPECT_NEAR(curves.distance({0, 0, 0}, {2, 2, std::numbers::pi / 2}), std::numbers::pi, 1e-9);
}

TEST(ReedsShepp, TurnsRoundOnTheSpotInThreeArcs) {
  // The well-known three-point turn by 180 degrees: pi radii long, each arc a third of a half
  // circle.
  EXPECT_NEAR(ReedsShepp(1.0).distance({0, 0, 0}, {0, 0, std::numbers::pi}), std::numbers::pi,
              1e-9);
}

TEST(ReedsShepp, EveryWordEndsAtTheGoalAndRespectsTheRadius) {
  RandomStream random(5, "reeds_shepp_test");
  const ReedsShepp curves(0.9);
  for (int trial = 0; trial < 5000; ++trial) {
    const double extent = trial % 2 == 0 ? 1.5 : 8.0;
    const Pose2 from{random.uniform(-extent, extent), random.uniform(-extent, extent),
                     random.uniform(-std::numbers::pi, std::numbers::pi)};
    const Pose2 to{random.uniform(-extent, extent), random.uniform(-extent, extent),
                   random.uniform(-std::numbers::pi, std::numbers::pi)};
    ReedsShepp::Words words;
    curves.connect(from, to, words);
    ASSERT_GT(words.count, 0U);
    for (std::size_t i = 0; i < words.count; ++i) {
      const Pose2 end = words.paths[i].end(from);
      EXPECT_NEAR(end.x, to.x, 1e-6);
      EXPECT_NEAR(end.y, to.y, 1e-6);
      EXPECT_NEAR(angle_difference(end.yaw, to.yaw), 0.0, 1e-6);
      for (const Arc& arc : words.paths[i].arcs)
        EXPECT_LE(std::abs(arc.curvature), 1.0 / 0.9 + 1e-9);
    }
  }
}

TEST(ReedsShepp, DistanceIsSymmetricAndObeysTheTriangleInequality) {
  RandomStream random(6, "reeds_shepp_test");
  const ReedsShepp curves(1.0);
  const auto pose = [&random] {
    return Pose2{random.uniform(-3, 3), random.uniform(-3, 3),
                 random.uniform(-std::numbers::pi, std::numbers::pi)};
  };
  for (int trial = 0; trial < 3000; ++trial) {
    const Pose2 a = pose();
    const Pose2 b = pose();
    const Pose2 c = pose();
    const double ab = curves.distance(a, b);
    EXPECT_NEAR(ab, curves.distance(b, a), 1e-6);
    EXPECT_GE(ab + 1e-9, distance(a, b));
    EXPECT_LE(ab, curves.distance(a, c) + curves.distance(c, b) + 1e-6);
  }
}

}  // namespace
}  // namespace coop::global_planner
