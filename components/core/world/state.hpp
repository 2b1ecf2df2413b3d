#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"

/// The simulated world as the topics `world` (once) and `ground_truth` (50 Hz) tell it. Frame of
/// everything: `world`, which is the frame of the world's map file. coop_msgs/World and GroundTruth
/// carry these structs field by field.
namespace coop::world {

/// Cells of at least 50 percent are solid; unknown ones lie outside the house and stop nothing.
[[nodiscard]] constexpr bool is_occupied(std::int8_t occupancy) {
  return occupancy >= 50;
}

/// Numbers as in coop_msgs/SimEgg.
enum class EggState : std::uint8_t {
  kOnFloor = 0,
  kInGripper = 1,
  kCollected = 2,  ///< in the robot's basket; the position goes with the robot
  kBroken = 3,
};

struct Egg {
  std::string id;
  Eigen::Vector3d position{
      0, 0, 0};  ///< centre of the ellipsoid, m in world; on the floor z = kEggHalfWidth
  EggState state = EggState::kOnFloor;
  bool operator==(const Egg&) const = default;
};

/// An animal: a disc of height kAnimalHeight.
struct Animal {
  std::string id;
  Eigen::Vector2d position{0, 0};  ///< centre, m in world
  Eigen::Vector2d velocity{0, 0};  ///< m/s in world
  double radius = 0.0;             ///< m
  bool operator==(const Animal&) const = default;
};

/// A heap of manure: a disc on the floor. Numbers as in coop_msgs/SimHeap.
enum class HeapState : std::uint8_t { kOnFloor = 0, kCleaned = 1 };
struct Heap {
  std::string id;
  Eigen::Vector2d position{0, 0};  ///< centre, m in world
  double radius = 0.0;             ///< m
  HeapState state = HeapState::kOnFloor;
  bool operator==(const Heap&) const = default;
};

/// What does not change while the simulation runs.
struct World {
  std::string map_path;
  OccupancyGrid
      grid;  ///< map file with the world's walls added; unknown cells lie outside the house
  std::vector<Egg> eggs;  ///< as laid at the start
  Pose2 robot_start;      ///< base_link in world
  std::uint64_t seed = 0;
  std::vector<Heap> heaps;  ///< as they lie at the start
};

/// What is true at one moment.
struct GroundTruth {
  Time stamp{};
  Pose2 robot_in_world;
  Twist2 velocity;              ///< in base_link
  double steering_angle = 0.0;  ///< rad, of the virtual middle wheel
  bool in_collision = false;    ///< touches something it has not yet backed away from
  std::uint32_t collision_count = 0;
  std::uint32_t animal_collision_count = 0;  ///< of these, with an animal
  std::vector<Egg> eggs;
  std::vector<Animal> animals;
  std::vector<Heap> heaps;
};

}  // namespace coop::world
