#include <gtest/gtest.h>

#include "dwa/tracked_path.hpp"

namespace coop::dwa {
namespace {

/// 3 m forwards along x, then 2 m backwards.
std::vector<Pose2> there_and_back() {
  std::vector<Pose2> poses;
  for (int i = 0; i <= 60; ++i) poses.push_back({0.05 * i, 0, 0});
  for (int i = 1; i <= 40; ++i) poses.push_back({3.0 - 0.05 * i, 0.002 * i, 0});
  return poses;
}

TEST(TrackedPathJoin, ANewPlanIsFollowedFromItsBeginning) {
  TrackedPath path;
  path.set(there_and_back(), {0.02, 0, 0});
  EXPECT_EQ(path.direction(), 1);
  EXPECT_FALSE(path.on_last_segment());
}

TEST(TrackedPathJoin, APlanThatBeganLongAgoIsJoinedWhereTheRobotIs) {
  std::vector<Pose2> poses = there_and_back();
  TrackedPath path;
  path.set(poses, {2.0, 0.04, 0});  // beside the way back
  EXPECT_LT(path.offset({2.0, 0.04, 0}), 0.06);
}

}  // namespace
}  // namespace coop::dwa
