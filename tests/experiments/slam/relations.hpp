#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"

namespace coop::experiments {

/// A line `t1 t2 x y z roll pitch yaw` of a relations file: the true pose at t2 seen from the pose
/// at t1.
struct Relation {
  Time from{};
  Time to{};
  Pose2 truth;
};

/// Error of a trajectory by the relations metric (Burgard et al., A Comparison of SLAM Algorithms
/// Based on a Graph of Relations, 2009, equation 3).
struct RelationsError {
  std::size_t relations = 0;
  double mean_translation = 0.0;    ///< m
  double stddev_translation = 0.0;  ///< m
  double max_translation = 0.0;     ///< m
  double mean_rotation = 0.0;       ///< rad, absolute
  double stddev_rotation = 0.0;     ///< rad
};

/// Throws std::runtime_error with file and line.
[[nodiscard]] std::vector<Relation> parse_relations(std::string_view text, const std::string& name);

/// Pose at `stamp`, interpolated linearly between the neighbours; the first or last beyond the
/// ends. The trajectory is not empty and ordered by stamp.
[[nodiscard]] Pose2 pose_at(std::span<const StampedPose2> trajectory, Time stamp);

/// What the trajectory's pose at `to` seen from that at `from` lacks of the truth.
[[nodiscard]] Pose2 error_of(const Relation& relation, std::span<const StampedPose2> trajectory);

[[nodiscard]] RelationsError relations_error(std::span<const Relation> relations,
                                             std::span<const StampedPose2> trajectory);

[[nodiscard]] std::string to_text(const RelationsError& error);

}  // namespace coop::experiments
