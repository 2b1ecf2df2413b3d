#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "coop_msgs/msg/GroundTruth.h"
#include "coop_msgs/msg/MissionStatus.h"

namespace coop::chaos {

/// How far the robot has really gone at a simulated time.
struct Motion {
  double time = 0.0;      ///< s
  double distance = 0.0;  ///< m over ground since the start, whichever way
};

/// How the robot behaved while something it needs to drive was lost.
struct Stopping {
  bool was_moving = false;
  bool is_safe = true;
  double begun_after = 0.0;  ///< s after the loss from which on it only became slower
};

/// The base brakes with this at the least, m/s^2, and follows its set point with this delay, s.
inline constexpr double kBraking = 0.8;
inline constexpr double kDriveDelay = 0.3;
/// s after the loss of what it needs by which the robot must brake.
inline constexpr double kReaction = 0.3;

/// Judges the motion from `lost` to `found` (s of simulated time): from kReaction after the loss on
/// it must not become faster, and must be at rest in the time that braking takes. Where the loss
/// lasted for less than kReaction, nothing is asked for. `clock_error`: s by which `lost` may be
/// early.
[[nodiscard]] Stopping judge_stopping(const std::vector<Motion>& motion, double lost, double found,
                                      double clock_error);

/// Eggs of the mission against those of the world. Empty where they agree.
[[nodiscard]] std::vector<std::string> judge_eggs(const coop_msgs::msg::MissionStatus& mission,
                                                  const coop_msgs::msg::GroundTruth& truth);

}  // namespace coop::chaos
