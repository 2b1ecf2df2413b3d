#include "amcl/beams.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace coop::amcl {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Four beams: ahead, left, behind, right.
LaserScan cross(std::vector<float> ranges) {
  LaserScan scan;
  scan.angle_increment = std::numbers::pi_v<float> / 2.0F;
  scan.range_min = 0.1F;
  scan.range_max = 30.0F;
  scan.ranges = std::move(ranges);
  return scan;
}

TEST(SelectBeams, PutsBeamEndsIntoBaseLink) {
  BeamEnds ends;
  select_beams(cross({1, 2, 3, 4}), {0.5, 0, std::numbers::pi / 2}, 4, 20, 0, ends);
  ASSERT_EQ(ends.size(), 4u);
  // The laser looks left: its "ahead" is +y of the base.
  EXPECT_NEAR(ends.x[0], 0.5, 1e-6);
  EXPECT_NEAR(ends.y[0], 1.0, 1e-6);
  EXPECT_NEAR(ends.x[1], 0.5 - 2.0, 1e-6);
  EXPECT_NEAR(ends.y[1], 0.0, 1e-6);
  EXPECT_NEAR(ends.y[2], -3.0, 1e-6);
  EXPECT_NEAR(ends.x[3], 0.5 + 4.0, 1e-6);
}

TEST(SelectBeams, LeavesOutWhatIsNoMeasurement) {
  BeamEnds ends;
  select_beams(cross({kInf, kNan, 0.05F, 31.0F}), {}, 4, 20, 0, ends);
  EXPECT_EQ(ends.size(), 0u);
  select_beams(cross({-kInf, kNan, kNan, kNan}), {}, 4, 20, 0, ends);
  EXPECT_EQ(ends.size(), 0u);
  select_beams(cross({25.0F, 2.0F, kNan, 1.0F}), {}, 4, 20, 0, ends);
  EXPECT_EQ(ends.size(), 2u) << "25 m is above max_range";
}

TEST(SelectBeams, TakesExactlyAsManyAsAskedEvenlySpacedForEveryPhase) {
  LaserScan scan = cross({});
  scan.angle_increment = 0.01F;
  for (int i = 0; i < 361; ++i) scan.ranges.push_back(1.0F);
  std::set<int> used;
  for (std::size_t phase = 0; phase < 20; ++phase) {
    BeamEnds ends;
    select_beams(scan, {}, 60, 20, phase, ends);
    ASSERT_EQ(ends.size(), 60u);
    int previous = -1;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const double angle =
          std::atan2(static_cast<double>(ends.y[i]), static_cast<double>(ends.x[i]));
      const int beam =
          static_cast<int>(std::lround((angle < 0 ? angle + 2 * std::numbers::pi : angle) * 100));
      if (previous >= 0) {
        EXPECT_GE(beam - previous, 6);
        EXPECT_LE(beam - previous, 7);
      }
      previous = beam;
      used.insert(beam);
    }
  }
  EXPECT_GE(used.size(), 350u) << "successive scans use different beams";
}

}  // namespace
}  // namespace coop::amcl
