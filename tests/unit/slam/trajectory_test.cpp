#include "slam/trajectory.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "slam/trajectory_file.hpp"

namespace coop::slam {
namespace {

Time at(double seconds) {
  return time_from_seconds(seconds);
}

TEST(Trajectory, OfNothingIsEmpty) {
  EXPECT_TRUE(interpolate_trajectory({}, std::vector<StampedPose2>{{at(1), {}}}).empty());
}

TEST(Trajectory, KeepsTheShapeOfOdometryBetweenNodesThatAgreeWithIt) {
  // The map is the odometry's frame turned by 90 degrees.
  const std::vector<TrajectoryNode> nodes{{at(0), {0, 0, 0}, {0, 0, M_PI_2}},
                                          {at(2), {2, 0, 0}, {0, 2, M_PI_2}}};
  const std::vector<StampedPose2> odometry{
      {at(0), {0, 0, 0}}, {at(1), {1, 0.5, 0.1}}, {at(2), {2, 0, 0}}};
  const auto trajectory = interpolate_trajectory(nodes, odometry);
  ASSERT_EQ(trajectory.size(), 3U);
  EXPECT_NEAR(trajectory[1].pose.x, -0.5, 1e-12);
  EXPECT_NEAR(trajectory[1].pose.y, 1.0, 1e-12);
  EXPECT_NEAR(trajectory[1].pose.yaw, M_PI_2 + 0.1, 1e-12);
}

TEST(Trajectory, SpreadsWhatOdometryMissesOverTheTimeBetweenNodes) {
  const std::vector<TrajectoryNode> nodes{{at(0), {0, 0, 0}, {0, 0, 0}},
                                          {at(4), {4, 0, 0}, {4.4, 0.8, 0}}};
  const std::vector<StampedPose2> odometry{{at(1), {1, 0, 0}}, {at(4), {4, 0, 0}}};
  const auto trajectory = interpolate_trajectory(nodes, odometry);
  EXPECT_NEAR(trajectory[0].pose.x, 1.1, 1e-12);
  EXPECT_NEAR(trajectory[0].pose.y, 0.2, 1e-12);
  EXPECT_NEAR(trajectory[1].pose.x, 4.4, 1e-12);
}

TEST(Trajectory, GoesOnWithOdometryBeyondTheNodes) {
  const std::vector<TrajectoryNode> nodes{{at(10), {5, 0, 0}, {1, 1, M_PI_2}}};
  const std::vector<StampedPose2> odometry{{at(9), {4, 0, 0}}, {at(12), {7, 0, 0}}};
  const auto trajectory = interpolate_trajectory(nodes, odometry);
  EXPECT_NEAR(trajectory[0].pose.y, 0.0, 1e-12);
  EXPECT_NEAR(trajectory[1].pose.y, 3.0, 1e-12);
}

TEST(TrajectoryFile, ReadsBackWhatItWrote) {
  const std::vector<StampedPose2> trajectory{
      {Time(Duration(976052890244111001)), {1.5, -2.25, 0.5}}, {at(7), {0, 0, -3}}};
  const auto again = parse_trajectory(to_text(trajectory), "t");
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0].stamp, trajectory[0].stamp) << "stamps are exact to the nanosecond";
  EXPECT_EQ(again[0].pose, trajectory[0].pose);
  EXPECT_EQ(again[1].pose, trajectory[1].pose);
}

TEST(TrajectoryFile, NamesTheLineThatHoldsNoPose) {
  try {
    (void)parse_trajectory("# fine\n1.0 2 3 4\n2.0 2 x 4\n", "walk.txt");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "walk.txt:3: expected y of the pose, a number, found 'x'");
  }
}

}  // namespace
}  // namespace coop::slam
