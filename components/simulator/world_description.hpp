#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/world/state.hpp"
#include "simulator/flock.hpp"
#include "simulator/robot_shape.hpp"

namespace coop::simulator {

struct StartPose {
  double x = 0.0;    ///< m in world
  double y = 0.0;    ///< m in world
  double yaw = 0.0;  ///< rad
  void describe(config::Fields& fields);
};

struct EggPlace {
  std::string id;  ///< empty: egg_<number>
  double x = 0.0;  ///< m in world
  double y = 0.0;  ///< m in world
  void describe(config::Fields& fields);
};

/// Eggs laid at random where the robot can pick them up.
struct RandomEggs {
  int count = 0;
  std::int64_t seed = -1;        ///< -1: the seed of the simulation
  std::vector<double> region;    ///< x_min, y_min, x_max, y_max, m in world; empty: everywhere
  double wall_clearance = 0.45;  ///< m from everything solid
  double spacing = 0.60;         ///< m between eggs, and from the robot's outline at the start
  double lead_in = 0.60;  ///< m of free straight way behind the place from which the egg is picked
  double margin = 0.10;   ///< m kept free around the robot on that way
  void describe(config::Fields& fields);
};

/// A wall added to the map: a straight segment.
struct WallSegment {
  double x1 = 0.0;  ///< m in world
  double y1 = 0.0;
  double x2 = 0.0;
  double y2 = 0.0;
  double thickness = 0.1;  ///< m
  void describe(config::Fields& fields);
};

/// A solid rectangle added to the map, along the axes.
struct SolidBox {
  double x_min = 0.0;  ///< m in world
  double y_min = 0.0;
  double x_max = 0.0;
  double y_max = 0.0;
  void describe(config::Fields& fields);
};

/// The file maps/<name>.world.yaml: a map and what lives in it.
struct WorldDescription {
  std::string map;  ///< map YAML, relative to this file
  StartPose robot_start;
  std::vector<EggPlace> eggs;
  RandomEggs random_eggs;
  std::vector<WallSegment> walls;
  std::vector<SolidBox> boxes;
  std::vector<AnimalDescription> animals;

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// The world of a description over its map (as loaded). Same description, map, robot and seed: same
/// world. Throws config::Error where the robot starts in a wall, an egg or animal lies in one, or
/// the random eggs find no room.
[[nodiscard]] world::World build_world(const WorldDescription& description, OccupancyGrid map,
                                       const RobotShape& robot, std::uint64_t seed);

}  // namespace coop::simulator
