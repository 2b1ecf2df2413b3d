#pragma once
#include "core/pose.hpp"
#include "core/robot/working_range.hpp"
#include "referee/attempt.hpp"

namespace coop::referee {

/// What is true and what the robot believes when it stands at its goal.
struct Standing {
  Time stamp{};
  Pose2 robot_in_map;           ///< true
  Pose2 believed_robot_in_map;  ///< by localisation
  Eigen::Vector2d egg_in_map{0, 0};
  Eigen::Vector2d believed_egg_in_map{0, 0};  ///< by the mission
};

/// Takes the deviation from the working point apart into the errors that make it up; they add up to
/// it exactly. The believed egg was placed with localisation as it was when the egg was seen: an
/// error of that time counts as one of the egg's position.
[[nodiscard]] Arrival analyse(const Standing& standing, const Eigen::Vector2d& working_point);

/// The one error without which the egg would have been in range; of several, that without which it
/// would lie nearest to the middle. kNone where it is in range.
[[nodiscard]] Cause cause_of_miss(const Arrival& arrival, const robot::WorkingRange& range);

}  // namespace coop::referee
