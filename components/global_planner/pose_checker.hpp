#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/config/fields.hpp"
#include "core/costmap/collision_checker.hpp"
#include "core/costmap/distance_field.hpp"
#include "core/pose.hpp"
#include "core/result.hpp"

namespace coop::global_planner {

struct PoseCheckerConfig {
  double padding = 0.07;        ///< m around the footprint on the way
  double tight_padding = 0.04;  ///< m near a start or goal where `padding` does not fit
  /// m near a start that is blocked even so: the robot stands there, so the map or its pose is a
  /// little wrong
  double escape_padding = -0.05;
  double tight_distance = 0.8;  ///< m from start or goal within which its padding holds

  void describe(config::Fields& fields);
};

enum class PoseFailure : std::uint8_t { kStartBlocked, kGoalBlocked };

/// Whether the robot fits at a pose: with the full padding on the way, with less near a start or
/// goal that leaves no room for it.
class PoseChecker {
 public:
  PoseChecker(const PoseCheckerConfig& config, const std::vector<Eigen::Vector2d>& footprint,
              double resolution);

  /// The largest distance the field must know, m.
  [[nodiscard]] double reach() const { return checkers_.front().reach(); }

  /// Chooses the padding at start and goal. `field` must outlive the query.
  Result<void, PoseFailure> prepare(const DistanceField& field, const Pose2& start,
                                    const Pose2& goal);
  [[nodiscard]] bool free(const CollisionChecker::Placement& at) const;
  [[nodiscard]] bool free(const Pose2& pose) const { return free(CollisionChecker::place(pose)); }
  /// Of the padded footprint, m; see CollisionChecker::clearance.
  [[nodiscard]] double clearance(const CollisionChecker::Placement& at) const {
    return checkers_.front().clearance(*field_, at);
  }

  /// Whether the pose can be a goal at all.
  [[nodiscard]] bool fits(const DistanceField& field, const Pose2& pose) const {
    return !checkers_[kTight].collides(field, pose);
  }

 private:
  enum Level : std::size_t { kFull, kTight, kEscape };

  PoseCheckerConfig config_;
  std::vector<CollisionChecker> checkers_;  ///< by level
  const DistanceField* field_ = nullptr;
  Pose2 start_;
  Pose2 goal_;
  std::size_t start_level_ = kFull;
  std::size_t goal_level_ = kFull;
};

}  // namespace coop::global_planner
