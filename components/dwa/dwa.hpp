#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/odometry.hpp"
#include "core/pose.hpp"
#include "core/scan.hpp"
#include "core/time.hpp"
#include "dwa/animal_check.hpp"
#include "dwa/config.hpp"
#include "dwa/driven_track.hpp"
#include "dwa/local_map.hpp"
#include "dwa/tracked_path.hpp"
#include "dwa/trajectory_chooser.hpp"

namespace coop::dwa {

enum class DriveState : std::uint8_t { kIdle, kDriving, kArrived, kFailed };

/// Why the robot stands or asks for help.
enum class DriveReason : std::uint8_t {
  kNone,
  kNoPose,       ///< odometry or the transform map -> odom missing or stale
  kSensorStale,  ///< no scan for too long
  kEmergencyStop,
  kStuck,       ///< driving: blocked, a new plan is wanted; failed: given up
  kMissedGoal,  ///< driving: at the end of the plan but not at the goal, a new plan is wanted
};

struct DwaInputs {
  std::optional<Odometry> odometry;         ///< latest
  std::optional<StampedPose2> odom_in_map;  ///< latest
  std::optional<Time> scan_stamp;           ///< of the latest scan taken in by integrate()
  bool emergency_stop = false;
};

struct DwaOutput {
  Twist2 command;  ///< for base_link; zero whenever `state` is not driving or a reason stands
  DriveState state = DriveState::kIdle;
  DriveReason reason = DriveReason::kNone;
  std::string detail;
  double distance_remaining = 0.0;  ///< m along the plan
};

/// The local planner: follows the global plan by choosing, twenty times a second, the best velocity
/// that can be reached and whose trajectory is free (dynamic window approach, egg paper
/// section 2.3.3), and knows when it has arrived, when it is blocked and when to stop.
class Dwa {
 public:
  Dwa(const DwaConfig& config, const std::vector<Eigen::Vector2d>& footprint,
      const vehicle::AckermannGeometry& base, double steering_rate);

  /// A new plan (poses in map; empty: stop). The same `goal_id` as before: the same goal,
  /// replanned.
  void set_plan(const std::string& goal_id, std::vector<Pose2> poses_in_map);
  [[nodiscard]] const std::string& goal_id() const { return goal_id_; }

  [[nodiscard]] LocalMap& local_map() { return local_map_; }
  [[nodiscard]] AnimalCheck& animals() { return animals_; }

  /// One control step at `now`, every control_period.
  DwaOutput update(const DwaInputs& inputs, Time now);

  /// The trajectory chosen in the last step, in odom; empty while standing.
  [[nodiscard]] const Trajectory& chosen() const { return chosen_; }
  [[nodiscard]] std::span<const Candidate> candidates() const { return chooser_.candidates(); }
  [[nodiscard]] const Costmap& costmap() const { return local_map_.costmap(); }

 private:
  enum class Mode : std::uint8_t { kIdle, kFollow, kAwaitPlan, kBackUp, kArrived, kFailed };

  /// Where the robot is in this step.
  struct Here {
    Time now;
    Pose2 base_in_odom;
    Pose2 odom_in_map;
    double speed;  ///< m/s
    [[nodiscard]] Pose2 base_in_map() const { return odom_in_map * base_in_odom; }
  };

  [[nodiscard]] DriveReason check_inputs(const DwaInputs& inputs, Time now,
                                         std::string& detail) const;
  [[nodiscard]] Here locate(const DwaInputs& inputs, Time now);
  void estimate_steering(double speed, double omega);
  DwaOutput stand(DriveReason reason, std::string detail);
  DwaOutput drive(const Here& here);
  DwaOutput follow_plan(const Here& here);
  DwaOutput finish(const Here& here);
  DwaOutput blocked(const Here& here);
  DwaOutput await_plan(const Here& here);
  DwaOutput back_up(const Here& here);
  void start_back_up(const Here& here);
  [[nodiscard]] bool progressing(const Here& here);
  /// The command along `path`, whose frame is `path_in_odom`; nothing where every trajectory
  /// collides.
  std::optional<Command> steer(const Here& here, const TrackedPath& path, const Pose2& path_in_odom,
                               double max_speed);
  [[nodiscard]] double speed_limit(const Here& here, const TrackedPath& path, double remaining);
  DwaOutput driving(const Command& command);

  DwaConfig config_;
  vehicle::AckermannGeometry base_;
  double steering_rate_;
  TrajectoryChooser chooser_;
  LocalMap local_map_;
  AnimalCheck animals_;
  DrivenTrack track_;

  Mode mode_ = Mode::kIdle;
  std::string goal_id_;
  std::vector<Pose2> plan_;  ///< the last one given, in map
  bool has_new_plan_ = false;
  TrackedPath path_;  ///< in map
  TrackedPath back_;  ///< in odom
  double steering_ = 0.0;
  double wanted_steering_ = 0.0;
  Time last_update_{};
  Time blocked_since_{};  ///< Time{}: not blocked
  Time mode_since_{};
  Time progress_at_{};
  double best_to_goal_ = 0.0;
  int back_ups_ = 0;
  int misses_ = 0;
  std::vector<Pose2> window_;  ///< of the path, in odom
  Trajectory chosen_;
};

}  // namespace coop::dwa
