#pragma once
#include <string>

#include "core/config/fields.hpp"
#include "core/costmap/animal_tracks.hpp"
#include "core/costmap/costmap.hpp"
#include "core/costmap/obstacle_layer.hpp"

namespace coop::dwa {

/// Equation (10) and what goes into it. The defaults of alpha, beta, gamma and the prediction time
/// are those the egg paper found best.
struct CriticConfig {
  double alpha = 0.05;           ///< weight of head
  double beta = 0.10;            ///< weight of dist
  double gamma = 0.10;           ///< weight of velocity
  double path_weight = 10.0;     ///< weight of the error along the plan; not in the paper
  double path_scale = 0.05;      ///< m: an error of this size costs path_weight
  double heading_arm = 0.25;     ///< m: a heading error counts as an error on an arm of this length
  double match_distance = 0.3;   ///< m: piece of plan a trajectory is compared with
  double target_distance = 1.0;  ///< m: head's target lies this far ahead on the plan
  double max_obstacle_distance = 1.5;  ///< m: dist does not grow beyond

  void describe(config::Fields& fields);
};

/// Equations (7) and (8).
struct WindowConfig {
  double window_time = 0.30;  ///< s: the velocities that can be reached in this time are sampled
  int speed_samples = 7;      ///< m + 1 in equation (7)
  int steering_samples = 21;  ///< n + 1 in equation (7)

  void describe(config::Fields& fields);
};

/// Equations (5) and (6).
struct PredictionConfig {
  double prediction_time = 3.0;  ///< s
  double prediction_step = 0.1;  ///< s
  double padding = 0.02;         ///< m around the footprint that must stay free

  void describe(config::Fields& fields);
};

struct SpeedConfig {
  double max_vel_x = 0.6;                  ///< m/s forwards
  double max_reverse = 0.3;                ///< m/s backwards
  double acceleration = 0.5;               ///< m/s^2, both ways
  double braking = 0.30;                   ///< m/s^2 planned for stopping at a point
  double max_lateral_acceleration = 0.25;  ///< m/s^2
  double creep_speed = 0.04;               ///< m/s: slowest speed on the way to a stopping point
  double narrow_clearance = 0.30;          ///< m: with less free space on the way ahead slower
  double narrow_speed = 0.20;              ///< m/s with no free space at all

  void describe(config::Fields& fields);
};

struct ArrivalConfig {
  double stop_distance = 0.012;     ///< m before a stopping point at which the base is told to stop
  double along_tolerance = 0.05;    ///< m, at the goal
  double lateral_tolerance = 0.06;  ///< m, of the point `reach` ahead of base_link
  double reach = 0.92;              ///< m: the arm's working point ahead of base_link

  void describe(config::Fields& fields);
};

struct RecoveryConfig {
  /// s: odometry or a scan older than this stops the base. With a control period until that is
  /// seen, and as much for the way to the base and its drive, braking has begun 0.3 s after the
  /// last of them. Two periods of the laser: one scan may be lost on the way.
  double input_timeout = 0.20;
  double transform_timeout = 0.05;  ///< s: the same of the transform, which is dated ahead
  double blocked_time = 1.5;  ///< s without an admissible trajectory before a new plan is asked for
  double patience = 4.0;      ///< s blocked before the base backs up
  double back_up_distance = 0.5;  ///< m along the track it came on
  double give_up_time = 30.0;     ///< s without progress before the goal is reported stuck
  int max_back_ups = 4;           ///< for one goal

  void describe(config::Fields& fields);
};

struct LocalMapConfig {
  double size = 6.0;         ///< m, edge of the square around the robot
  double resolution = 0.03;  ///< m a cell
  double static_tolerance =
      0.15;             ///< m: an obstacle of the map this close to one that was seen is that one
  bool use_map = true;  ///< obstacles of the static map where the laser has not looked
  int occupied_from = 65;  ///< percent
  InflationConfig inflation{};
  ObstacleLayerConfig obstacles{.obstacle_range = 4.0, .clearing_range = 5.0, .persistence = 10.0};

  void describe(config::Fields& fields);
};

/// Animals told by a camera above; see AnimalCheck.
struct AnimalCheckConfig : AnimalTracksConfig {
  bool use = false;      ///< whether there is a topic `animals` to listen to
  double horizon = 1.0;  ///< s: trajectories are checked so far ahead

  void describe(config::Fields& fields);
};

struct DwaConfig {
  /// aligned: the paper's terms and the error along the plan, forwards and backwards. paper:
  /// equations (5) to (10) alone.
  std::string mode = "aligned";
  double control_period = 0.05;  ///< s
  SpeedConfig speed;
  WindowConfig window;
  PredictionConfig prediction;
  CriticConfig critic;
  ArrivalConfig arrival;
  RecoveryConfig recovery;
  LocalMapConfig local_map;
  AnimalCheckConfig animals;

  void describe(config::Fields& fields);
  [[nodiscard]] bool paper() const { return mode == "paper"; }
};

}  // namespace coop::dwa
