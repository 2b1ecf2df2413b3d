#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "slam/tile_map.hpp"
#include "slam/trajectory.hpp"

namespace coop::slam {

/// What a mapper leaves for the one that takes its place when it dies: map and way of the best
/// particle, and odometry as the track had it.
struct Session {
  TileMap map{0.05};
  std::vector<TrajectoryNode> nodes;  ///< base_in_odom is base_in_track; not empty
  StampedPose2 base_in_track;         ///< newest reading of odometry
  Pose2 odom_in_track;
  std::string odometry_source;
};

/// What is kept of odometry: at the scans used, and the newest; ascending.
[[nodiscard]] std::vector<StampedPose2> track_of(const Session& session);

/// A line that names the format, a checksum of the rest, the rest: numbers as this machine keeps
/// them, of the map the known cells.
[[nodiscard]] std::string to_bytes(const Session& session);

/// The reason where the bytes are no whole session: cut, altered, of another format.
[[nodiscard]] Result<Session> parse_session(std::string_view bytes);

}  // namespace coop::slam
