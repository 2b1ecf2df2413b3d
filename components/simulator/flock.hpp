#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/grid.hpp"
#include "core/random.hpp"
#include "core/world/state.hpp"

namespace coop::simulator {

/// One animal as the world's file places it.
struct AnimalDescription {
  std::string id;        ///< empty: animal_<number>
  double x = 0.0;        ///< m in world
  double y = 0.0;        ///< m in world
  double radius = 0.14;  ///< m
  double speed = 0.20;   ///< m/s while walking

  void describe(config::Fields& fields);
};

struct FlockConfig {
  double wandering = 0.6;         ///< rad per sqrt(s), random walk of the heading
  double mean_walk = 6.0;         ///< s between rests
  double mean_rest = 3.0;         ///< s
  double wall_clearance = 0.10;   ///< m kept from walls
  bool stop_before_robot = true;  ///< animals stand still near the robot
  double robot_clearance = 0.40;  ///< m at which they do

  void describe(config::Fields& fields);
};

/// Animals that walk at random, turn away from walls and each other, and never step onto the robot.
/// Each has a number stream of its own.
class Flock {
 public:
  Flock(const FlockConfig& config, const std::vector<AnimalDescription>& animals,
        std::uint64_t seed);

  /// `robot`: the robot's outline in world.
  void step(double dt, const OccupancyGrid& grid, std::span<const Eigen::Vector2d> robot);

  [[nodiscard]] const std::vector<world::Animal>& animals() const { return animals_; }

  template <class Archive>
  void persist(Archive& archive) {
    for (world::Animal& animal : animals_) archive(animal.position, animal.velocity);
    for (Walk& walk : walks_) archive(walk.random, walk.heading, walk.until_change, walk.resting);
  }

 private:
  struct Walk {
    RandomStream random;
    double speed;         ///< m/s while walking
    double heading;       ///< rad in world
    double until_change;  ///< s until it rests or walks on
    bool resting = false;
  };
  [[nodiscard]] bool is_free(std::size_t who, const Eigen::Vector2d& place,
                             const OccupancyGrid& grid,
                             std::span<const Eigen::Vector2d> robot) const;

  FlockConfig config_;
  std::vector<world::Animal> animals_;
  std::vector<Walk> walks_;
};

}  // namespace coop::simulator
