#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "core/grid.hpp"
#include "core/pose_estimate.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace coop::amcl {

/// What is kept on disk so that localisation goes on after a restart.
struct SavedPose {
  Time stamp{};
  std::uint64_t map_hash = 0;  ///< of the map the pose belongs to
  PoseEstimate robot_in_map;
  Pose2 base_in_odom;  ///< odometry at the stamp
};

/// Fingerprint of a map: geometry and cells.
[[nodiscard]] std::uint64_t hash_of(const OccupancyGrid& map);

/// One line of JSON.
[[nodiscard]] std::string to_text(const SavedPose& saved);
/// The reason where the text is no saved pose, or one with impossible numbers.
[[nodiscard]] Result<SavedPose> parse_saved_pose(std::string_view text);

/// Where the robot is now. If the odometry may have run on since (the time is short and the way
/// plausible), its motion is added; otherwise (it was restarted, the robot was off) the robot is
/// taken to stand where it was. The covariance grows by 5 cm and 0.05 rad, and by a tenth of the
/// way and of the turn driven in between.
[[nodiscard]] PoseEstimate resume(const SavedPose& saved, Time now, const Pose2& base_in_odom);

}  // namespace coop::amcl
