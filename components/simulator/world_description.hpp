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

/// Places drawn at random, of things for the robot to get at: eggs to pick up, heaps to clean.
struct RandomPlaces {
  int count = 0;
  std::int64_t seed = -1;        ///< -1: the seed of the simulation
  std::vector<double> region;    ///< x_min, y_min, x_max, y_max, m in world; empty: everywhere
  double wall_clearance = 0.45;  ///< m from everything solid
  double spacing = 0.60;         ///< m between them, and from the robot's outline at the start
  double lead_in = 0.60;  ///< m of free straight way behind the place where the robot stands for it
  double margin = 0.10;   ///< m kept free around the robot on that way
  void describe(config::Fields& fields);
};

struct HeapPlace {
  std::string id;        ///< empty: heap_<number>
  double x = 0.0;        ///< m in world
  double y = 0.0;        ///< m in world
  double radius = 0.07;  ///< m
  void describe(config::Fields& fields);
};

/// Heaps of manure dropped at random, where the robot's scraper gets at them.
struct RandomHeaps : RandomPlaces {
  double min_radius = 0.05;  ///< m
  double max_radius = 0.09;  ///< m
  void describe(config::Fields& fields);
};

/// Animals at random places, alike.
struct RandomAnimals {
  int count = 0;
  std::int64_t seed = -1;        ///< -1: the seed of the simulation
  std::vector<double> region;    ///< x_min, y_min, x_max, y_max, m in world; empty: everywhere
  double radius = 0.25;          ///< m
  double speed = 0.25;           ///< m/s while walking
  double clearance = 0.12;       ///< m at the start, from walls and each other
  double robot_clearance = 0.5;  ///< m at the start, from the robot
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
  RandomPlaces random_eggs;
  std::vector<HeapPlace> heaps;
  RandomHeaps random_heaps;
  std::vector<WallSegment> walls;
  std::vector<SolidBox> boxes;
  std::vector<AnimalDescription> animals;
  RandomAnimals random_animals;

  void describe(config::Fields& fields);
  void validate() const;  ///< throws config::Error
};

/// The world of a description over its map (as loaded). Same description, map, robot and seed: same
/// world. Throws config::Error where the robot starts in a wall, an egg, heap or animal lies in
/// one, or what is random finds no room.
[[nodiscard]] world::World build_world(const WorldDescription& description, OccupancyGrid map,
                                       const RobotShape& robot, std::uint64_t seed);

}  // namespace coop::simulator
