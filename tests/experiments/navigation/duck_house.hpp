#pragma once
#include <optional>

#include "core/costmap/distance_field.hpp"
#include "core/costmap/footprint.hpp"
#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/random.hpp"

namespace coop::test {

/// The robot of these experiments: footprint and smallest turning radius of the egg collector,
/// base_link at the rear axle.
struct ExperimentRobot {
  std::vector<Eigen::Vector2d> footprint{
      {-0.18, -0.28}, {0.77, -0.28}, {0.77, 0.28}, {-0.18, 0.28}};
  double wheelbase = 0.55;     // m
  double track = 0.48;         // m
  double max_steering = 0.60;  // rad
  double laser_x = 0.62;       // m before base_link
};

/// Where the egg is to lie in base_link when the robot has arrived (egg paper, section 2.3.2).
inline const Eigen::Vector2d kWorkingPoint{0.92, 0.0};

/// A duck house of 14 m x 9 m in 5 cm cells: walls, nest boxes along them, posts, a feeder, a pen
/// wall with a gate.
[[nodiscard]] OccupancyGrid make_duck_house();

/// One task: where the robot stands, where the egg lies.
struct EggTask {
  Pose2 start;
  Eigen::Vector2d egg;
};

/// Draws tasks: a robot with 0.10 m of free space around it, an egg at least 0.08 m from every
/// obstacle that can be reached from at least one side.
class TaskSource {
 public:
  TaskSource(const OccupancyGrid& house, const ExperimentRobot& robot);
  [[nodiscard]] EggTask draw(RandomStream& random) const;

  /// Equation (4): the pose 0.92 m before the egg on the line from the robot. Where the robot does
  /// not fit there, the free pose on the same circle whose direction is nearest to that line, and
  /// with `skip` the skip-th next of them; nothing where there are no more.
  [[nodiscard]] std::optional<Pose2> goal_for(const Pose2& robot, const Eigen::Vector2d& egg,
                                              int skip = 0) const;
  /// Whether the bare robot stands on an obstacle of the house.
  [[nodiscard]] bool collides(const Pose2& robot) const;

 private:
  OccupancyGrid house_;
  Footprint bare_;
  Footprint goal_room_;
  Footprint start_room_;
  DistanceField distances_;
};

}  // namespace coop::test
