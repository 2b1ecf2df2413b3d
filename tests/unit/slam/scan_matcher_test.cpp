#include "slam/scan_matcher.hpp"

#include <gtest/gtest.h>

#include "slam/map_updater.hpp"
#include "support/simulated_room.hpp"

namespace coop::slam {
namespace {

const Eigen::Vector3d kDoubtful{0.3, 0.3, 0.3};  // odometry says little
const Pose2 kTruth{3.0, 1.5, 0.4};

/// The barn as one scan from the true pose draws it, and that scan.
class ScanMatcherTest : public testing::Test {
 protected:
  ScanMatcherTest() : drive_(test::barn(), kTruth, 7) {
    const LaserScan scan = drive_.scan(0);
    points_ = to_points(scan, drive_.laser_in_base, {}, {});
    MapUpdater().integrate(map_, points_, kTruth);
  }

  [[nodiscard]] ScanPoints another_scan() {
    return to_points(drive_.scan(0), drive_.laser_in_base, {}, {});
  }
  /// The pose the proposal's mean stands for.
  static Pose2 mean_pose(const Proposal& proposal, const Pose2& predicted) {
    return predicted * Pose2{proposal.mean.x(), proposal.mean.y(), proposal.mean.z()};
  }

  test::SimulatedDrive drive_;
  TileMap map_{0.05};
  ScanPoints points_;
};

TEST_F(ScanMatcherTest, RecoversAKnownOffsetInADrawnRoom) {
  ScanMatcher matcher({});
  for (const Pose2& offset : {Pose2{0.12, -0.07, 0.06}, {-0.15, 0.1, -0.05}, {0.0, 0.0, 0.1}}) {
    const Pose2 predicted = kTruth * offset;
    const Proposal proposal = matcher.match(map_, another_scan(), predicted, kDoubtful);
    EXPECT_TRUE(proposal.matched);
    const Pose2 found = mean_pose(proposal, predicted);
    EXPECT_LT(distance(found, kTruth), 0.01);
    EXPECT_LT(std::abs(angle_difference(found.yaw, kTruth.yaw)), 0.003);
  }
}

TEST_F(ScanMatcherTest, SearchesWideWhereOdometryIsFarOff) {
  ScanMatcher matcher({});
  const Pose2 predicted = kTruth * Pose2{0.45, -0.4, 0.5};
  const Pose2 found =
      mean_pose(matcher.match(map_, another_scan(), predicted, kDoubtful), predicted);
  EXPECT_LT(distance(found, kTruth), 0.01);
  EXPECT_LT(std::abs(angle_difference(found.yaw, kTruth.yaw)), 0.003);
}

TEST_F(ScanMatcherTest, FollowsOdometryWhereThereIsNoMap) {
  const Proposal proposal = ScanMatcher({}).match(TileMap(0.05), points_, kTruth, {0.1, 0.2, 0.3});
  EXPECT_FALSE(proposal.matched);
  EXPECT_EQ(proposal.mean, Eigen::Vector3d::Zero());
  EXPECT_NEAR(proposal.covariance(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(proposal.covariance(1, 1), 0.04, 1e-12);
  EXPECT_NEAR(proposal.covariance(2, 2), 0.09, 1e-12);
  EXPECT_EQ(proposal.log_evidence, 0.0);
}

TEST_F(ScanMatcherTest, TrustsOdometryThatIsSureOfItself) {
  const Pose2 predicted = kTruth * Pose2{0.1, 0.0, 0.0};
  const Proposal proposal =
      ScanMatcher({}).match(map_, another_scan(), predicted, {1e-4, 1e-4, 1e-4});
  EXPECT_LT(proposal.mean.norm(), 0.005);
}

TEST_F(ScanMatcherTest, EvidenceIsLargerOnTheRightMap) {
  TileMap other(0.05);
  test::SimulatedDrive elsewhere(test::barn(), {7.0, 4.0, 2.0}, 7);
  MapUpdater().integrate(other, to_points(elsewhere.scan(0), elsewhere.laser_in_base, {}, {}),
                         kTruth);
  ScanMatcher matcher({});
  const double right = matcher.match(map_, another_scan(), kTruth, kDoubtful).log_evidence;
  const double wrong = matcher.match(other, another_scan(), kTruth, kDoubtful).log_evidence;
  EXPECT_GT(right, wrong + 2.0);
}

TEST_F(ScanMatcherTest, IsUncertainAlongACorridorAndSureAcross) {
  // Two walls along x at y = -1 and y = 1, as long as the laser sees.
  ScanPoints corridor;
  for (float x = -5.0F; x <= 5.0F; x += 0.05F) {
    corridor.ends.emplace_back(x, 1.0F);
    corridor.ends.emplace_back(x, -1.0F);
  }
  corridor.match = corridor.ends;
  TileMap map(0.05);
  ScanPoints longer = corridor;
  for (float x = 5.0F; x <= 8.0F; x += 0.05F) {
    for (const float side : {-1.0F, 1.0F}) {
      longer.ends.emplace_back(x, side);
      longer.ends.emplace_back(-x, side);
    }
  }
  MapUpdater().integrate(map, longer, {});
  const Proposal proposal = ScanMatcher({}).match(map, corridor, {}, {0.1, 0.1, 0.05});
  EXPECT_GT(std::sqrt(proposal.covariance(0, 0)), 0.05);
  EXPECT_LT(std::sqrt(proposal.covariance(1, 1)), 0.02);
}

TEST_F(ScanMatcherTest, AnswersTheSameEveryTime) {
  ScanMatcher matcher({});
  const Pose2 predicted = kTruth * Pose2{0.05, 0.05, 0.05};
  const Proposal first = matcher.match(map_, points_, predicted, kDoubtful);
  (void)matcher.match(map_, another_scan(), kTruth,
                      kDoubtful);  // scratch space was used for others
  const Proposal again = matcher.match(map_, points_, predicted, kDoubtful);
  EXPECT_EQ(first.mean, again.mean);
  EXPECT_EQ(first.covariance, again.covariance);
  EXPECT_EQ(first.log_evidence, again.log_evidence);
}

}  // namespace
}  // namespace coop::slam
