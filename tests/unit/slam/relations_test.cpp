#include "experiments/slam/relations.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace coop::experiments {
namespace {

Time at(double seconds) {
  return time_from_seconds(seconds);
}

// One metre ahead, then a quarter turn to the left, then one metre ahead.
const std::vector<StampedPose2> kWalk{
    {at(0), {0, 0, 0}}, {at(1), {1, 0, 0}}, {at(2), {1, 0, M_PI_2}}, {at(3), {1, 1, M_PI_2}}};

TEST(Relations, APerfectTrajectoryHasNoError) {
  const std::vector<Relation> relations{
      {at(0), at(1), {1, 0, 0}}, {at(1), at(3), {0, 1, M_PI_2}}, {at(3), at(2), {-1, 0, 0}}};
  const auto error = relations_error(relations, kWalk);
  EXPECT_EQ(error.relations, 3U);
  EXPECT_NEAR(error.mean_translation, 0.0, 1e-12);
  EXPECT_NEAR(error.mean_rotation, 0.0, 1e-12);
}

TEST(Relations, ErrorIsThatOfThePoseSeenFromTheOther) {
  // The first is short by 0.3 m sideways, the second turned by 0.2 rad and right in place.
  const std::vector<Relation> relations{{at(0), at(1), {1, 0.3, 0}}, {at(2), at(3), {1, 0, 0.2}}};
  const auto error = relations_error(relations, kWalk);
  EXPECT_NEAR(error.mean_translation, 0.15, 1e-12);
  EXPECT_NEAR(error.stddev_translation, 0.15, 1e-12);
  EXPECT_NEAR(error.max_translation, 0.3, 1e-12);
  EXPECT_NEAR(error.mean_rotation, 0.1, 1e-12);
}

TEST(Relations, PosesAreInterpolatedBetweenStampsAndHeldBeyondTheEnds) {
  EXPECT_NEAR(pose_at(kWalk, at(0.25)).x, 0.25, 1e-12);
  EXPECT_NEAR(pose_at(kWalk, at(1.5)).yaw, M_PI_4, 1e-12);
  EXPECT_EQ(pose_at(kWalk, at(-5)), kWalk.front().pose);
  EXPECT_EQ(pose_at(kWalk, at(99)), kWalk.back().pose);
}

TEST(Relations, DoNotDependOnWhereTheMapLies) {
  const std::vector<Relation> relations{{at(0), at(3), {1.1, 1, 1.5}}};
  std::vector<StampedPose2> moved = kWalk;
  for (auto& entry : moved) entry.pose = Pose2{7, -3, 2.2} * entry.pose;
  EXPECT_NEAR(relations_error(relations, kWalk).mean_translation,
              relations_error(relations, moved).mean_translation, 1e-12);
}

TEST(Relations, FileIsReadAndBadLinesAreNamed) {
  const auto relations =
      parse_relations("976052905.167303 976052911.885496 -0.5 -0.1 0 0 0 -1.6\n", "r");
  ASSERT_EQ(relations.size(), 1U);
  EXPECT_EQ(to_nanoseconds(relations[0].from), 976052905167303000);
  EXPECT_EQ(relations[0].truth, (Pose2{-0.5, -0.1, -1.6}));
  EXPECT_THROW((void)parse_relations("1 2 3 4\n", "r"), std::runtime_error);
}

}  // namespace
}  // namespace coop::experiments
