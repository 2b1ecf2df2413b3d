#include "global_planner/path_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/config/error.hpp"
#include "global_planner/planning_map.hpp"
#include "unit/global_planner/drawn_map.hpp"

namespace coop::global_planner {
namespace {

using test::draw_map;
using test::draw_room;
using test::kRobotFootprint;
using test::kTurningRadius;

class PathPlannerTest : public testing::Test {
 protected:
  void use(const OccupancyGrid& map) {
    map_.set_map(map);
    map_.update(Time{});
  }
  Result<Plan, PlanFailure> plan(const Pose2& start, const Pose2& goal, int direction = 0) {
    return planner_.plan(map_.costmap(), start, goal, direction);
  }

  PathPlannerConfig config_;
  PathPlanner planner_{config_, kRobotFootprint, kTurningRadius, RandomStream(1, "planner")};
  PlanningMap map_{{}, Footprint(kRobotFootprint), config_.poses.padding, planner_.reach(0.05)};
};

/// Largest curvature between neighbouring poses, and whether all lie on the way of a car: no
/// sideways step.
void expect_drivable(const Plan& plan) {
  for (std::size_t i = 1; i < plan.poses.size(); ++i) {
    const Pose2 step = plan.poses[i - 1].inverse() * plan.poses[i];
    const double length = std::hypot(step.x, step.y);
    if (length < 1e-9) continue;
    EXPECT_LE(std::abs(step.yaw) / length, 1.0 / kTurningRadius + 1e-6) << "pose " << i;
    EXPECT_NEAR(std::atan2(step.y, std::abs(step.x)), std::copysign(0.5, step.x) * step.yaw, 1e-6);
  }
}

int count_cusps(const Plan& plan) {
  int cusps = 0;
  double last = 0.0;
  for (std::size_t i = 1; i < plan.poses.size(); ++i) {
    const double along = (plan.poses[i - 1].inverse() * plan.poses[i]).x;
    if (along * last < 0.0) ++cusps;
    if (along != 0.0) last = along;
  }
  return cusps;
}

TEST_F(PathPlannerTest, DrivesStraightToAGoalAhead) {
  use(draw_room());
  const auto result = plan({1.5, 2.5, 0.0}, {4.0, 2.5, 0.0});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->length, 2.5, 1e-6);
  EXPECT_EQ(result->poses.front(), (Pose2{1.5, 2.5, 0.0}));
  EXPECT_EQ(result->poses.back(), (Pose2{4.0, 2.5, 0.0}));
  expect_drivable(*result);
}

TEST_F(PathPlannerTest, PosesAreCloseTogether) {
  use(draw_room());
  const auto result = plan({1.5, 1.5, 0.0}, {4.0, 3.5, std::numbers::pi / 2});
  ASSERT_TRUE(result);
  for (std::size_t i = 1; i < result->poses.size(); ++i) {
    EXPECT_LE(distance(result->poses[i - 1], result->poses[i]), 0.05 + 1e-6);
  }
}

TEST_F(PathPlannerTest, TurnsRoundInSeveralMovesWhereTheGoalIsBehind) {
  use(draw_room());
  const auto result = plan({2.5, 2.5, 0.0}, {2.5, 2.5, -std::numbers::pi});
  ASSERT_TRUE(result);
  expect_drivable(*result);
  EXPECT_GE(count_cusps(*result), 1);
  EXPECT_LT(result->length, 8.0);
}

TEST_F(PathPlannerTest, ArrivesOnAStraightLineWhereThereIsRoom) {
  use(draw_room());
  const auto result = plan({1.2, 1.2, std::numbers::pi / 2}, {4.2, 2.5, 0.0});
  ASSERT_TRUE(result);
  const Pose2 goal = result->poses.back();
  double straight = 0.0;
  for (std::size_t i = result->poses.size(); i-- > 1;) {
    const Pose2 seen = goal.inverse() * result->poses[i - 1];
    if (std::abs(seen.y) > 1e-3 || std::abs(seen.yaw) > 1e-3 || seen.x > 0.0) break;
    straight = -seen.x;
  }
  EXPECT_GE(straight, config_.drivable_search.approach_length - 0.05);
}

TEST_F(PathPlannerTest, KeepsTheFootprintFreeAllTheWay) {
  use(draw_map({"############",  //
                "#..........#",  //
                "#..........#",  //
                "#..........#",  //
                "#.....#....#",  //
                "#.....#....#",  //
                "#.....#....#",  //
                "#.....#....#",  //
                "#.....#....#",  //
                "############"}));
  const auto result = plan({1.5, 1.5, std::numbers::pi / 2}, {4.5, 1.8, -std::numbers::pi / 2});
  ASSERT_TRUE(result);
  expect_drivable(*result);
  const CollisionChecker bare(Footprint(kRobotFootprint), 0.05);
  for (const Pose2& pose : result->poses) {
    EXPECT_FALSE(bare.collides(map_.costmap().distances(), pose));
  }
}

TEST_F(PathPlannerTest, DoesNotGoThroughAGapNarrowerThanTheRobot) {
  // The left gap is 0.5 m wide, the robot 0.56 m; the right one is 1.5 m wide.
  use(draw_map({"################",  //
                "#..............#",  //
                "#..............#",  //
                "#..............#",  //
                "#..............#",  //
                "###.########...#",  //
                "#..............#",  //
                "#..............#",  //
                "#..............#",  //
                "#..............#",  //
                "################"}));
  const auto result = plan({1.75, 1.5, std::numbers::pi / 2}, {1.75, 4.0, std::numbers::pi / 2});
  ASSERT_TRUE(result);
  EXPECT_GT(result->length, 8.0);
}

TEST_F(PathPlannerTest, TellsThatTheGoalIsOutsideTheMap) {
  use(draw_room());
  EXPECT_EQ(plan({2, 2, 0}, {20, 2, 0}).error().reason, PlanFailureReason::kGoalOutside);
}

TEST_F(PathPlannerTest, TellsThatTheRobotIsOutsideTheMap) {
  use(draw_room());
  EXPECT_EQ(plan({-3, 2, 0}, {2, 2, 0}).error().reason, PlanFailureReason::kStartOutside);
}

TEST_F(PathPlannerTest, TellsThatTheGoalIsUnknownUnlessUnknownIsAllowed) {
  const OccupancyGrid map = draw_map({"########????",  //
                                      "#..........?",  //
                                      "#..........?",  //
                                      "#..........?",  //
                                      "#......?????",  //
                                      "#......?????",  //
                                      "########????"});
  use(map);
  const Pose2 start{1.2, 1.5, 0.0};
  const Pose2 goal{4.5, 2.2, 0.0};
  EXPECT_TRUE(plan(start, goal));
  const Pose2 unknown{5.7, 2.2, 0.0};
  EXPECT_EQ(plan(start, unknown).error().reason, PlanFailureReason::kGoalUnknown);
}

TEST_F(PathPlannerTest, OffersTheNearestFreePoseForABlockedGoal) {
  use(draw_room());
  const Pose2 goal{5.2, 2.5, 0.0};  // the nose would be in the wall, which begins at 5.5 m
  const auto result = plan({1.5, 2.5, 0.0}, goal);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().reason, PlanFailureReason::kGoalBlocked);
  ASSERT_TRUE(result.error().alternative);
  const Pose2 alternative = *result.error().alternative;
  EXPECT_NEAR(alternative.x, 4.7, 0.11);
  EXPECT_NEAR(alternative.y, 2.5, 0.11);
  EXPECT_TRUE(plan({1.5, 2.5, 0.0}, alternative));
}

TEST_F(PathPlannerTest, TellsThatThereIsNoWay) {
  use(draw_map({"#############",  //
                "#.....#.....#",  //
                "#.....#.....#",  //
                "#.....#.....#",  //
                "#.....#.....#",  //
                "#.....#.....#",  //
                "#############"}));
  EXPECT_EQ(plan({1.5, 1.5, 0}, {4.5, 1.5, 0}).error().reason, PlanFailureReason::kNoPath);
}

TEST_F(PathPlannerTest, ShowsProgressDuringALongSearch) {
  use(draw_room());
  int signs = 0;
  planner_.on_progress([&signs] { ++signs; });
  ASSERT_TRUE(plan({1.5, 2.5, 0.0}, {4.0, 2.5, 0.0}));
  EXPECT_GE(signs, 1);
  const int of_an_easy_search = std::exchange(signs, 0);
  // Backwards into a corner, turned round: hundreds of states.
  (void)plan({1.2, 1.2, 0.0}, {1.2, 3.8, -std::numbers::pi / 2.0});
  EXPECT_GT(signs, of_an_easy_search);
}

TEST_F(PathPlannerTest, TellsThatTheRobotStandsOnAnObstacle) {
  use(draw_room());
  EXPECT_EQ(plan({0.4, 2.5, 0.0}, {3, 2.5, 0}).error().reason, PlanFailureReason::kStartBlocked);
}

TEST_F(PathPlannerTest, LeavesTheInflatedZoneItStandsIn) {
  use(draw_room());
  // The flank is 2 cm from the wall: inside the inscribed zone and nearer than any padding allows
  // on the way.
  const auto result = plan({2.0, 0.80, 0.0}, {4.0, 2.5, 0.0});
  ASSERT_TRUE(result);
  expect_drivable(*result);
}

TEST_F(PathPlannerTest, LeavesEvenWhereItSeemsToTouchTheWall) {
  use(draw_room());
  // By an error of localisation the flank is 3 cm inside the wall.
  EXPECT_TRUE(plan({2.0, 0.75, 0.0}, {4.0, 2.5, 0.0}));
}

TEST_F(PathPlannerTest, ChangingTheDirectionOfTravelAtOnceCostsACusp) {
  use(draw_room());
  const Pose2 start{1.5, 2.5, 0.0};
  const Pose2 goal{4.0, 2.5, 0.0};
  const auto at_rest = plan(start, goal, 0);
  const auto forwards = plan(start, goal, 1);
  const auto backwards = plan(start, goal, -1);
  ASSERT_TRUE(at_rest && forwards && backwards);
  EXPECT_NEAR(forwards->cost, at_rest->cost, 1e-6);
  EXPECT_NEAR(backwards->cost - at_rest->cost, config_.drivable_search.arc_cost.cusp_cost, 1e-4);
}

class GridPathPlanner : public ::testing::TestWithParam<std::string_view> {
 protected:
  GridPathPlanner() {
    map_.set_map(draw_room());
    map_.update(Time{});
  }
  static PathPlannerConfig config() {
    PathPlannerConfig config;
    config.planner = GetParam();
    if (config.planner == kJumpPoint) config.traversal.restricted_weight = 0.0;
    return config;
  }
  PathPlanner planner_{config(), kRobotFootprint, kTurningRadius, RandomStream(1, "planner")};
  PlanningMap map_{{}, Footprint(kRobotFootprint), config().poses.padding, planner_.reach(0.05)};
};

TEST_P(GridPathPlanner, TurnsEveryPoseAlongThePathAndEndsWithTheGoalsHeading) {
  const Costmap& costmap = map_.costmap();
  const Pose2 start{1.5, 1.5, 0.0};
  const Pose2 goal{4.0, 3.5, 1.0};
  const auto result = planner_.plan(costmap, start, goal, 0);
  ASSERT_TRUE(result) << result.error().detail;
  EXPECT_EQ(result->poses.back(), goal);
  EXPECT_GE(result->length, distance(start, goal));
  for (std::size_t i = 1; i + 1 < result->poses.size(); ++i) {
    const Pose2 step = result->poses[i - 1].inverse() * result->poses[i];
    // Smoothing leaves bends of the grid's 45 or 90 degrees spread over several poses.
    EXPECT_NEAR(std::atan2(step.y, step.x), 0.0, 0.6) << "pose " << i;
    const Cell cell = costmap.geometry().cell_of(result->poses[i].position());
    EXPECT_LT(zone_of(costmap.cost_at(cell)), Zone::kLethalZone);
  }
}

TEST_P(GridPathPlanner, SaysWhyThereIsNoPath) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  for (const Pose2& goal : {Pose2{400.0, 3.5, 1.0}, Pose2{1e300, 3.5, 1.0},
                            Pose2{kNoNumber, 3.5, 1.0}, Pose2{4.0, 3.5, kNoNumber}}) {
    const auto outside = planner_.plan(map_.costmap(), {1.5, 1.5, 0.0}, goal, 0);
    ASSERT_FALSE(outside) << goal.x << " " << goal.yaw;
    EXPECT_EQ(outside.error().reason, PlanFailureReason::kGoalOutside);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryPlanner, GridPathPlanner,
                         ::testing::ValuesIn(std::vector(kPlanners.begin() + 1, kPlanners.end())),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(PathPlannerConfig, JumpPointIsRefusedWhereCellsHavePrices) {
  PathPlannerConfig config;
  config.planner = kJumpPoint;
  EXPECT_THROW(config.validate(), config::Error);
  config.traversal.restricted_weight = 0.0;
  EXPECT_NO_THROW(config.validate());
}

}  // namespace
}  // namespace coop::global_planner
