#include "core/costmap/collision_checker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/random.hpp"

namespace coop {
namespace {

constexpr double kPi = std::numbers::pi;
const std::vector<Eigen::Vector2d> kRobot{
    {-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}};

/// 4 m x 4 m of 5 cm cells with obstacles at the given points.
DistanceField field_with(const std::vector<Eigen::Vector2d>& obstacles) {
  const GridGeometry grid{80, 80, 0.05, {0.0, 0.0}};
  std::vector<std::uint8_t> cells(grid.size(), 0);
  for (const Eigen::Vector2d& point : obstacles) cells[grid.index(grid.cell_of(point))] = 1;
  DistanceField field;
  field.update(grid, cells, 1.5);
  return field;
}

TEST(CollisionChecker, FindsAnObstacleUnderTheNoseAndUnderTheMiddle) {
  const CollisionChecker checker(Footprint(kRobot), 0.05);
  const Pose2 robot{2.0, 2.0, 0.0};
  EXPECT_TRUE(checker.collides(field_with({{2.73, 2.0}}), robot));
  EXPECT_TRUE(checker.collides(field_with({{2.3, 2.1}}), robot));
  EXPECT_TRUE(checker.collides(field_with({{1.87, 1.77}}), robot));
}

TEST(CollisionChecker, LetsPassWhatIsBesideTheRobot) {
  const CollisionChecker checker(Footprint(kRobot), 0.05);
  const Pose2 robot{2.0, 2.0, 0.0};
  EXPECT_FALSE(checker.collides(field_with({}), robot));
  EXPECT_FALSE(checker.collides(field_with({{2.3, 2.33}}), robot));
  EXPECT_FALSE(checker.collides(field_with({{2.83, 2.0}}), robot));
  EXPECT_FALSE(checker.collides(field_with({{1.75, 2.0}}), robot));
}

TEST(CollisionChecker, TurnsTheFootprintWithThePose) {
  const CollisionChecker checker(Footprint(kRobot), 0.05);
  const DistanceField field = field_with({{2.0, 2.7}});
  EXPECT_FALSE(checker.collides(field, Pose2{2.0, 2.0, 0.0}));
  EXPECT_TRUE(checker.collides(field, Pose2{2.0, 2.0, kPi / 2}));
  EXPECT_FALSE(checker.collides(field, Pose2{2.0, 2.0, -kPi / 2}));
}

TEST(CollisionChecker, BeyondTheBorderIsAnObstacle) {
  const CollisionChecker checker(Footprint(kRobot), 0.05);
  EXPECT_TRUE(checker.collides(field_with({}), Pose2{3.5, 2.0, 0.0}));
  EXPECT_FALSE(checker.collides(field_with({}), Pose2{3.5, 2.0, kPi}));
}

TEST(CollisionChecker, AgreesWithSamplingTheFootprintDensely) {
  RandomStream random(3, "collision_checker_test");
  const Footprint footprint(kRobot);
  const CollisionChecker checker(footprint, 0.05);
  const Footprint larger(kRobot, 0.02);
  int hits = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::vector<Eigen::Vector2d> obstacles(1 + random.below(3));
    for (auto& point : obstacles) point = {random.uniform(1.0, 3.0), random.uniform(1.0, 3.0)};
    const DistanceField field = field_with(obstacles);
    const Pose2 robot{random.uniform(1.5, 2.5), random.uniform(1.5, 2.5),
                      random.uniform(-kPi, kPi)};
    // Points 1 cm apart: what they hit the checker must hit; what it hits must touch the outline
    // pushed out by 2 cm.
    const auto samples_hit = [&](const Footprint& outline) {
      for (double x = outline.lower().x(); x <= outline.upper().x(); x += 0.01) {
        for (double y = outline.lower().y(); y <= outline.upper().y(); y += 0.01) {
          if (field.squared_at(field.geometry().cell_of(robot * Eigen::Vector2d(x, y))) == 0)
            return true;
        }
      }
      return false;
    };
    const bool hit = checker.collides(field, robot);
    hits += hit ? 1 : 0;
    if (samples_hit(Footprint(kRobot, -0.02))) {
      EXPECT_TRUE(hit) << "trial " << trial;
    }
    if (hit) {
      EXPECT_TRUE(samples_hit(larger)) << "trial " << trial;
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(CollisionChecker, ClearanceIsTheFreeSpaceBesideTheRobot) {
  const CollisionChecker checker(Footprint(kRobot), 0.05);
  const Pose2 robot{2.025, 2.025, 0.0};  // in the middle of a cell
  EXPECT_NEAR(checker.clearance(field_with({{2.3, 2.525}}), robot), 0.5 - 0.28, 0.03);
  EXPECT_LT(checker.clearance(field_with({{2.3, 2.2}}), robot), 0.0);
}

}  // namespace
}  // namespace coop
