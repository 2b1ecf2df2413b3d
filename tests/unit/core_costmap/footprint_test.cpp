#include "core/costmap/footprint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace coop {
namespace {

/// Rear axle 0.2 m before the tail, 1 m long, 0.6 m wide.
const std::vector<Eigen::Vector2d> kBox{{-0.2, -0.3}, {0.8, -0.3}, {0.8, 0.3}, {-0.2, 0.3}};

TEST(Footprint, RadiiAreThoseOfTheDiscsAboutBaseLink) {
  const Footprint footprint(kBox);
  EXPECT_DOUBLE_EQ(footprint.inscribed_radius(), 0.2);  // the tail is nearest
  EXPECT_DOUBLE_EQ(footprint.circumscribed_radius(), std::hypot(0.8, 0.3));
  EXPECT_DOUBLE_EQ(footprint.half_width(), 0.3);
}

TEST(Footprint, PaddingPushesEveryEdgeOutwards) {
  const Footprint footprint(kBox, 0.1);
  EXPECT_NEAR(footprint.lower().x(), -0.3, 1e-12);
  EXPECT_NEAR(footprint.upper().x(), 0.9, 1e-12);
  EXPECT_NEAR(footprint.upper().y(), 0.4, 1e-12);
  EXPECT_NEAR(footprint.inscribed_radius(), 0.3, 1e-12);
}

TEST(Footprint, NegativePaddingShrinks) {
  EXPECT_NEAR(Footprint(kBox, -0.05).half_width(), 0.25, 1e-12);
}

TEST(Footprint, ContainsItsInsideAndItsEdge) {
  const Footprint footprint(kBox);
  EXPECT_TRUE(footprint.contains({0.79, 0.29}));
  EXPECT_TRUE(footprint.contains({0.8, 0.0}));
  EXPECT_FALSE(footprint.contains({0.81, 0.0}));
  EXPECT_FALSE(footprint.contains({-0.21, 0.0}));
}

TEST(Footprint, DepthIsTheDistanceToTheNearestEdgeInside) {
  const Footprint footprint(kBox);
  EXPECT_NEAR(footprint.depth({0.3, 0.1}), 0.2, 1e-12);
  EXPECT_LT(footprint.depth({0.3, 0.5}), 0.0);
}

TEST(Footprint, RefusesWhatIsNoOutlineAroundBaseLink) {
  EXPECT_THROW(Footprint({{0, 0}, {1, 0}}), std::invalid_argument);
  // clockwise
  EXPECT_THROW(Footprint({{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}), std::invalid_argument);
  // a dent
  EXPECT_THROW(Footprint({{-1, -1}, {1, -1}, {0.1, 0}, {1, 1}, {-1, 1}}), std::invalid_argument);
  // base_link outside
  EXPECT_THROW(Footprint({{1, -1}, {2, -1}, {2, 1}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(Footprint(kBox, -0.25), std::invalid_argument);
}

}  // namespace
}  // namespace coop
