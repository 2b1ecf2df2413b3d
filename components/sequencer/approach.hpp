#pragma once
#include <functional>
#include <optional>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/robot/working_range.hpp"

namespace coop::sequencer {

struct ApproachConfig {
  double distance = 0.92;     ///< m, d_pe: from base_link to the egg
  int headings = 24;          ///< poses tried on the circle around the egg
  double beyond = 0.05;       ///< m, of the blade beyond a heap at the end of the drive over it
  robot::WorkingRange reach;  ///< where the egg may lie on arrival

  void describe(config::Fields& fields);
};

/// Equation 4: the pose at `distance` from the egg on the line from the robot to it, heading to the
/// egg.
[[nodiscard]] Pose2 approach_pose(const Eigen::Vector2d& robot, const Eigen::Vector2d& egg,
                                  double distance);

/// Cost of getting to a pose in metres, nothing where the robot cannot stand there or get there.
using PoseCost = std::function<std::optional<double>(const Pose2&)>;

inline constexpr double kAttemptsApart = 0.35;  ///< rad between the headings of two attempts

/// Equation 4 where its pose can be taken; otherwise the pose on the same circle, heading to the
/// egg, that is cheapest. Headings within `avoid_near` rad of one in `avoid` (tried in vain before)
/// are passed over. Nothing where no pose can be taken.
[[nodiscard]] std::optional<Pose2> choose_approach(const Pose2& robot_in_map,
                                                   const Eigen::Vector2d& egg_in_map,
                                                   const ApproachConfig& config,
                                                   const PoseCost& cost,
                                                   const std::vector<double>& avoid = {},
                                                   double avoid_near = kAttemptsApart);

/// Whether the arm reaches the egg from here.
[[nodiscard]] bool is_within_reach(const Pose2& robot_in_map, const Eigen::Vector2d& egg_in_map,
                                   const ApproachConfig& config);

}  // namespace coop::sequencer
