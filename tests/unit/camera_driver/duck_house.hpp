#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "camera_driver/egg_detector.hpp"
#include "camera_driver/simulated_camera.hpp"
#include "core/map/map_file.hpp"
#include "core/random.hpp"
#include "core/robot/robot_model.hpp"
#include "core/world/shapes.hpp"

/// Scenes in the duck house of the demo, and what a detector makes of them.
namespace coop::camera_driver::test {

inline world::World duck_house() {
  world::World world;
  world.grid = map::load_map(std::string(COOP_SOURCE_DIR) + "/maps/duck_house.yaml");
  return world;
}

inline Pose3 camera_in_base() {
  return robot::RobotModel::load(std::string(COOP_SOURCE_DIR) + "/config/robot/egg_collector.urdf")
      .mount(robot::kCameraOpticalFrame);
}

/// No occupied cell within `clearance` of the point.
inline bool is_clear(const OccupancyGrid& grid, const Eigen::Vector2d& point, double clearance) {
  const int reach = static_cast<int>(std::ceil(clearance / grid.geometry.resolution));
  const Cell middle = grid.geometry.cell_of(point);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (grid.at_or({middle.x + x, middle.y + y}, kOccupied) != kFree) return false;
    }
  }
  return true;
}

/// A robot somewhere in the house, five eggs on the floor before it and three animals.
inline world::GroundTruth random_scene(const world::World& world, RandomStream& random,
                                       double egg_clearance = 0.10) {
  world::GroundTruth truth;
  truth.stamp = time_from_seconds(random.uniform(1.0, 1000.0));
  do {
    truth.robot_in_world = {random.uniform(0.8, 13.2), random.uniform(0.8, 8.2),
                            random.uniform(-3.14, 3.14)};
  } while (!is_clear(world.grid, truth.robot_in_world.position(), 0.3));
  for (int tries = 0; truth.eggs.size() < 5 && tries < 1000; ++tries) {
    const Eigen::Vector2d place = truth.robot_in_world * Eigen::Vector2d(random.uniform(0.85, 3.6),
                                                                         random.uniform(-1.8, 1.5));
    if (!is_clear(world.grid, place, egg_clearance)) continue;
    bool apart = true;
    for (const world::Egg& other : truth.eggs) {
      apart = apart && (other.position.head<2>() - place).norm() > 0.25;
    }
    if (!apart) continue;
    truth.eggs.push_back({"egg_" + std::to_string(random.below(100000)),
                          {place.x(), place.y(), world::kEggHalfWidth},
                          world::EggState::kOnFloor});
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d place =
        truth.robot_in_world * Eigen::Vector2d(random.uniform(1.3, 4.0), random.uniform(-2.0, 2.0));
    bool apart = true;
    for (const world::Egg& egg : truth.eggs) {
      apart = apart && (egg.position.head<2>() - place).norm() > 0.22;
    }
    if (apart) truth.animals.push_back({"duck_" + std::to_string(i), place, {0, 0}, 0.14});
  }
  return truth;
}

}  // namespace coop::camera_driver::test
