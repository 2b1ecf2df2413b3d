#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/world/state.hpp"

namespace coop::referee {

/// The drive to one goal of the navigation, as it truly was.
struct Leg {
  Eigen::Vector2d goal_in_map{0, 0};
  Time start{};
  Time end{};                ///< first within the goal's radius, or the end of the leg
  double straight = 0.0;     ///< m, from where the robot was to the goal
  double path_length = 0.0;  ///< m, driven from start to end
  bool reached = false;      ///< came within the goal's radius
  std::uint32_t collisions = 0;
};

/// Columns of legs.csv, and a row of it. Times are s of simulated time, lengths m.
[[nodiscard]] std::vector<std::string> leg_columns();
[[nodiscard]] std::vector<std::string> to_row(const Leg& leg, std::uint64_t seed, int number);

/// Measures the drives between goals: how far, how long, and whether the robot came there. A leg
/// begins with a goal of a new name and ends with the next one.
class Legs {
 public:
  /// `radius` in m: this near, a goal is reached.
  explicit Legs(double radius) : radius_(radius) {}

  /// The map's origin is the start pose of the world.
  void begin(const Pose2& map_in_world);
  void see(const world::GroundTruth& truth);
  void hear_goal(const std::string& goal_id, const Eigen::Vector2d& goal_in_map);
  /// The run is over.
  void end();
  /// Legs that are over, in order; each once.
  [[nodiscard]] std::vector<Leg> take_finished();

 private:
  double radius_;
  std::optional<Pose2> map_in_world_;
  std::optional<world::GroundTruth> truth_;
  std::string goal_id_;
  std::optional<Leg> open_;
  std::uint32_t collisions_before_ = 0;
  std::vector<Leg> finished_;
};

}  // namespace coop::referee
