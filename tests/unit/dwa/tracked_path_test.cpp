#include "dwa/tracked_path.hpp"

#include <gtest/gtest.h>

namespace coop::dwa {
namespace {

/// Ahead along x to 2 m, back to 1 m, and ahead again to 3 m, 5 cm apart.
std::vector<Pose2> zigzag() {
  std::vector<Pose2> poses;
  for (int i = 0; i <= 40; ++i) poses.push_back({0.05 * i, 0, 0});
  for (int i = 1; i <= 20; ++i) poses.push_back({2.0 - 0.05 * i, 0, 0});
  for (int i = 1; i <= 40; ++i) poses.push_back({1.0 + 0.05 * i, 0, 0});
  return poses;
}

TEST(TrackedPath, IsEmptyWithoutTwoPoses) {
  TrackedPath path;
  EXPECT_TRUE(path.empty());
  path.set({{1, 1, 0}}, {});
  EXPECT_TRUE(path.empty());
}

TEST(TrackedPath, IsCutWhereTheDirectionChanges) {
  TrackedPath path;
  path.set(zigzag(), {0, 0, 0});
  EXPECT_EQ(path.direction(), 1);
  EXPECT_FALSE(path.on_last_segment());
  EXPECT_NEAR(path.to_goal(), 5.0, 1e-9);
  path.next_segment();
  EXPECT_EQ(path.direction(), -1);
  EXPECT_NEAR(path.to_goal(), 3.0, 1e-9);
  path.next_segment();
  EXPECT_EQ(path.direction(), 1);
  EXPECT_TRUE(path.on_last_segment());
}

TEST(TrackedPath, ProgressDoesNotJumpToALaterPartAtTheSamePlace) {
  TrackedPath path;
  path.set(zigzag(), {0, 0, 0});
  for (int i = 0; i <= 15; ++i) path.follow({0.1 * i, 0.01, 0});
  EXPECT_NEAR(path.to_goal(), 3.5, 0.03);
  EXPECT_NEAR(path.to_segment_end({1.5, 0.01, 0}), 0.5, 1e-6);
}

TEST(TrackedPath, TheEndIsTheLineAcrossItsPose) {
  TrackedPath path;
  path.set(zigzag(), {0, 0, 0});
  for (int i = 0; i <= 39; ++i) path.follow({0.05 * i, 0.1, 0});
  EXPECT_NEAR(path.to_segment_end({1.95, 0.1, 0}), 0.05, 1e-9);
  EXPECT_NEAR(path.to_segment_end({2.03, 0.1, 0}), -0.03, 1e-9);
}

TEST(TrackedPath, GoesOnStraightBeyondASegmentsEnd) {
  TrackedPath path;
  path.set(zigzag(), {0, 0, 0});
  for (int i = 0; i <= 19; ++i) path.follow({0.1 * i, 0, 0});
  EXPECT_NEAR(path.pose_ahead(0.05).x, 1.95, 1e-9);
  EXPECT_NEAR(path.pose_ahead(0.5).x, 2.4, 1e-9);
  path.next_segment();
  EXPECT_NEAR(path.pose_ahead(0.5).x, 1.5, 1e-9);
  EXPECT_NEAR(path.pose_ahead(1.5).x, 0.5, 1e-9);
}

TEST(TrackedPath, APathThatBeganLongAgoIsJoinedWhereItFits) {
  TrackedPath path;
  std::vector<Pose2> poses;
  for (int i = 0; i <= 100; ++i) poses.push_back({0.05 * i, 0, 0});
  path.set(poses, {3.0, 0.05, 0});
  EXPECT_NEAR(path.to_goal(), 2.0, 0.06);
}

TEST(TrackedPath, OffsetIsTheDistanceBesideThePath) {
  TrackedPath path;
  path.set(zigzag(), {0, 0, 0});
  path.follow({0.3, 0.2, 0});
  EXPECT_NEAR(path.offset({0.3, 0.2, 0}), 0.2, 1e-6);
}

}  // namespace
}  // namespace coop::dwa
