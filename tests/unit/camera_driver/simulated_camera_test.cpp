#include "camera_driver/simulated_camera.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/config/error.hpp"
#include "unit/camera_driver/duck_house.hpp"

namespace coop::camera_driver {
namespace {

/// 4 m x 4 m of free floor around the origin; the cell of x = [1.5, 1.6) is a wall where asked for.
world::World field(bool wall) {
  world::World world;
  world.grid = OccupancyGrid({40, 40, 0.1, {-2.0, -2.0}}, kFree);
  for (int y = 0; wall && y < 40; ++y) world.grid[{35, y}] = kOccupied;
  return world;
}

SimulatedCameraConfig exact() {
  SimulatedCameraConfig config;
  config.noise.depth = {0.0, 0.0};
  config.noise.dropout = 0.0;
  config.noise.colour = 0.0;
  return config;
}

/// 1 m above the origin. Optical axis along `forward`, columns to the robot's right.
Pose3 mount(const Eigen::Vector3d& forward) {
  Pose3 pose = Pose3::Identity();
  const Eigen::Vector3d right(0, -1, 0);
  pose.linear() << right, forward.cross(right), forward;
  pose.translation() << 0.0, 0.0, 1.0;
  return pose;
}

Frame take(const world::World& world, const Pose3& where, const world::GroundTruth& truth,
           const SimulatedCameraConfig& config = exact()) {
  SimulatedCamera camera(config, world, where, 1);
  Frame frame;
  camera.take(truth, frame);
  return frame;
}

int depth_at(const Frame& frame, const Eigen::Vector2d& pixel) {
  return frame.depth.at<std::uint16_t>(static_cast<int>(std::lround(pixel.y())),
                                       static_cast<int>(std::lround(pixel.x())));
}

world::GroundTruth with_egg(const Eigen::Vector3d& position,
                            world::EggState state = world::EggState::kOnFloor) {
  world::GroundTruth truth;
  truth.stamp = time_from_seconds(1.0);
  truth.eggs.push_back({"egg", position, state});
  return truth;
}

TEST(SimulatedCamera, looking_straight_down_sees_the_floor_a_metre_away_everywhere) {
  const Frame frame = take(field(false), mount(-Eigen::Vector3d::UnitZ()), {});
  EXPECT_EQ(frame.colour.size(), cv::Size(424, 240));
  double least = 0.0;
  double most = 0.0;
  cv::minMaxLoc(frame.depth, &least, &most);
  EXPECT_EQ(least, 1000.0);
  EXPECT_EQ(most, 1000.0);
}

TEST(SimulatedCamera, an_egg_under_it_is_as_much_nearer_as_it_is_high_and_of_its_size) {
  const Pose3 where = mount(-Eigen::Vector3d::UnitZ());
  const auto truth = with_egg({0.1, 0.0, world::kEggHalfWidth});
  const Frame frame = take(field(false), where, truth);
  const Intrinsics camera = d435i_intrinsics(424, 240);
  const Eigen::Vector3d egg = where.inverse() * truth.eggs[0].position;
  EXPECT_NEAR(depth_at(frame, camera.project(egg)), 955, 1);
  // Its outline, pi times both half axes, at the depth of its centre.
  const double pixel = camera.fx * camera.fy / (0.9775 * 0.9775);
  const double outline = 3.14159 * world::kEggHalfLength * world::kEggHalfWidth * pixel;
  EXPECT_NEAR(cv::countNonZero(frame.depth < 999), outline, 0.05 * outline);
}

TEST(SimulatedCamera, follows_the_robot) {
  const Pose3 where = mount(-Eigen::Vector3d::UnitZ());
  auto truth = with_egg({0.5, 0.3, world::kEggHalfWidth});
  truth.robot_in_world = {0.5, 0.1, 1.5707963};
  const Frame frame = take(field(false), where, truth);
  const Intrinsics camera = d435i_intrinsics(424, 240);
  // The egg lies 0.2 m ahead.
  const Eigen::Vector3d in_base(0.2, 0.0, world::kEggHalfWidth);
  EXPECT_NEAR(depth_at(frame, camera.project(where.inverse() * in_base)), 955, 1);
}

TEST(SimulatedCamera, a_wall_ends_the_floor_and_hides_what_is_behind_it) {
  // 45 degrees down: the axis would meet the floor at x = 1; the wall's face stands at x = 1.5.
  const Pose3 where = mount(Eigen::Vector3d(1, 0, -1).normalized());
  const Intrinsics camera = d435i_intrinsics(424, 240);
  const Frame frame = take(field(true), where, {});
  const Eigen::Vector3d on_face = where.inverse() * Eigen::Vector3d(1.5, 0.0, 0.3);
  EXPECT_NEAR(depth_at(frame, camera.project(on_face)), 1000.0 * on_face.z(), 4.0);
  const auto truth = with_egg({1.62, 0.0, world::kEggHalfWidth});
  const Frame with_hidden = take(field(true), where, truth);
  EXPECT_EQ(cv::countNonZero(with_hidden.depth != frame.depth), 0);
}

TEST(SimulatedCamera, sees_the_top_of_a_block) {
  const Pose3 where = mount(-Eigen::Vector3d::UnitZ());
  world::GroundTruth truth;
  truth.robot_in_world = {1.45, 0.0, 0.0};
  const Frame frame = take(field(true), where, truth);
  const Intrinsics camera = d435i_intrinsics(424, 240);
  const Eigen::Vector3d top = where.inverse() * Eigen::Vector3d(0.1, 0.0, world::kObstacleHeight);
  EXPECT_EQ(depth_at(frame, camera.project(top)), 400);
}

TEST(SimulatedCamera, sees_eggs_in_the_gripper_and_animals_but_no_collected_eggs) {
  const Pose3 where = mount(-Eigen::Vector3d::UnitZ());
  const world::World world = field(false);
  const Eigen::Vector3d middle(0.0, 0.0, 0.2);
  const auto differs = [&](const world::GroundTruth& truth) {
    const Frame frame = take(world, where, truth);
    return cv::countNonZero(frame.depth != 1000) > 0;
  };
  EXPECT_TRUE(differs(with_egg(middle, world::EggState::kInGripper)));
  EXPECT_FALSE(differs(with_egg(middle, world::EggState::kCollected)));
  world::GroundTruth animal;
  animal.animals.push_back({"duck", {0.0, 0.0}, {0.0, 0.0}, 0.14});
  EXPECT_EQ(depth_at(take(world, where, animal), {212.0, 120.0}),
            1000 - static_cast<int>(1000 * world::kAnimalHeight));
}

TEST(SimulatedCamera, the_litter_stays_where_it_is_when_the_robot_moves) {
  const Pose3 where = mount(-Eigen::Vector3d::UnitZ());
  // 32 columns at the middle of the picture, 1 m away.
  const double step = 32.0 / d435i_intrinsics(424, 240).fx;
  world::GroundTruth moved;
  moved.robot_in_world = {0.0, -step, 0.0};
  const Frame before = take(field(false), where, {});
  const Frame after = take(field(false), where, moved);
  int same = 0;
  for (int column = 40; column < 360; ++column) {
    const auto there = before.colour.at<cv::Vec3b>(120, column + 32);
    same += after.colour.at<cv::Vec3b>(120, column) == there ? 1 : 0;
  }
  EXPECT_GT(same, 300);  // of 320; the others lie on the border between two cells
}

TEST(SimulatedCamera, blocks_of_pixels_drawn_without_rays_are_those_where_rays_meet_nothing) {
  const world::World world = test::duck_house();
  const Pose3 where = test::camera_in_base();
  const SimulatedCameraConfig config = exact();
  const PixelRays rays(d435i_intrinsics(config.width, config.height), where, world::kObstacleHeight,
                       config.range_max);
  const world::RayCaster walls(world.grid);
  SimulatedCamera camera(config, world, where, 1);
  RandomStream random(3, "poses");
  Frame frame;
  int with_walls = 0;
  for (int i = 0; i < 25; ++i) {
    world::GroundTruth truth = test::random_scene(world, random);
    truth.eggs.clear();
    truth.animals.clear();
    camera.take(truth, frame);
    const Pose3 robot = to_pose3(truth.robot_in_world);
    const Eigen::Vector3d origin = robot * where.translation();
    for (int row = 0; row < config.height; row += 3) {
      for (int column = 0; column < config.width; column += 3) {
        const Eigen::Vector3d direction =
            robot.linear() * where.linear() * rays.intrinsics().ray(column, row);
        const double level = direction.head<2>().norm();
        const double enter = (world::kObstacleHeight - origin.z()) / direction.z();
        double depth = -origin.z() / direction.z();
        const auto hit = walls.cast(origin.head<2>() + enter * direction.head<2>(),
                                    direction.head<2>() / level, (depth - enter) * level);
        if (hit) depth = enter + hit->range / level;
        with_walls += hit ? 1 : 0;
        ASSERT_NEAR(frame.depth.at<std::uint16_t>(row, column), 1000.0 * depth, 1.0)
            << "frame " << i << ", column " << column << ", row " << row;
      }
    }
  }
  EXPECT_GT(with_walls, 10000);
}

TEST(SimulatedCamera, refuses_a_nearest_depth_beyond_the_farthest) {
  SimulatedCameraConfig config;
  config.range_min = 7.0;
  EXPECT_THROW(config.validate(), config::Error);
}

}  // namespace
}  // namespace coop::camera_driver
