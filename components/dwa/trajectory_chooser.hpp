#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/costmap/collision_checker.hpp"
#include "core/costmap/distance_field.hpp"
#include "core/pose.hpp"
#include "core/vehicle/ackermann.hpp"
#include "dwa/animal_check.hpp"
#include "dwa/config.hpp"
#include "dwa/critic.hpp"
#include "dwa/dynamic_window.hpp"
#include "dwa/prediction.hpp"

namespace coop::dwa {

/// Spacing of Situation::path, m.
inline constexpr double kPathSpacing = 0.05;

/// What a choice depends on. Poses in the frame of the obstacles (odom).
struct Situation {
  Pose2 base;
  MotionState motion;
  int direction = 1;             ///< wanted: 1 forwards, -1 backwards
  double min_speed = 0.0;        ///< m/s, amount
  double max_speed = 0.0;        ///< m/s, amount
  double max_distance = 1e9;     ///< m: predictions end there
  Eigen::Vector2d target{0, 0};  ///< of head()
  std::span<const Pose2>
      path;  ///< where the robot is to be every kPathSpacing of driving, from here on
  const DistanceField* obstacles = nullptr;
  const AnimalCheck* animals = nullptr;  ///< none: not looked at
};

struct Candidate {
  Command command;
  Trajectory trajectory;
  double score = 0.0;  ///< of admissible ones
  bool admissible = false;
};

/// One control step of the dynamic window approach: sample (7, 8), predict (5, 6), drop what
/// collides, evaluate (9, 10), take the best. Keeps its arrays: no allocation after the first
/// steps.
class TrajectoryChooser {
 public:
  TrajectoryChooser(const DwaConfig& config, const std::vector<Eigen::Vector2d>& footprint,
                    const vehicle::AckermannGeometry& base, double steering_rate);

  /// The best admissible candidate, or nothing where every trajectory collides. Valid until the
  /// next call.
  [[nodiscard]] const Candidate* choose(const Situation& situation);

  /// All candidates of the last call.
  [[nodiscard]] std::span<const Candidate> candidates() const {
    return std::span(candidates_).first(count_);
  }

  /// Free space beside the bare footprint, m, at most about 1 m.
  [[nodiscard]] double clearance(const DistanceField& obstacles, const Pose2& base) const {
    return checkers_[1].clearance(obstacles, base);
  }
  /// Whether the padded robot stands free.
  [[nodiscard]] bool free(const DistanceField& obstacles, const Pose2& base) const {
    return !checkers_.front().collides(obstacles, base);
  }
  /// The largest distance the field must know, m.
  [[nodiscard]] double reach() const { return checkers_.front().reach(); }

 private:
  void sample(const Situation& situation);
  void predict(const Situation& situation, Candidate& candidate) const;
  [[nodiscard]] static bool is_free(const Situation& situation, const CollisionChecker* checker,
                                    const Trajectory& trajectory);
  [[nodiscard]] const CollisionChecker* checker_at(const Situation& situation) const;
  [[nodiscard]] Evaluation evaluate(const Situation& situation, const Candidate& candidate) const;
  [[nodiscard]] double path_error(const Situation& situation, const Command& command) const;

  DwaConfig config_;
  vehicle::AckermannGeometry base_;
  RampLimits limits_;
  DynamicWindow window_;
  /// From the padded footprint to one smaller than the robot. A robot that stands too close to
  /// something may leave: the first that is free where it stands decides.
  std::vector<CollisionChecker> checkers_;
  std::vector<Command> commands_;
  std::vector<Candidate> candidates_;
  std::size_t count_ = 0;
  std::vector<std::size_t> admissible_;
  std::vector<Evaluation> evaluations_;
  std::vector<double> scores_;
};

}  // namespace coop::dwa
