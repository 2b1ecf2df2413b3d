#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/config/fields.hpp"
#include "core/pose.hpp"
#include "core/robot/working_range.hpp"
#include "core/world/state.hpp"
#include "referee/attempt.hpp"

namespace coop::referee {

struct RefereeConfig {
  double same_egg = 0.5;          ///< m; an egg of the mission farther from every true one is false
  double standing_speed = 0.005;  ///< m/s, slower is standing
  robot::WorkingRange range;

  void describe(config::Fields& fields);
};

/// What the mission says of one egg.
struct MissionEgg {
  enum class Phase { kWaiting, kApproaching, kPicking, kOver };
  std::string id;
  Phase phase = Phase::kWaiting;
  int tries = 0;       ///< approaches begun
  std::string reason;  ///< of the last failure
  Eigen::Vector2d egg_in_map{0, 0};
};

struct MissionView {
  bool ended = false;
  std::vector<MissionEgg> eggs;
};

struct NavigationView {
  enum class Source { kPlanner, kDriver };
  enum class State { kUnderWay, kArrived, kFailed };
  Source source = Source::kPlanner;
  State state = State::kUnderWay;
  std::string goal_id;
};

/// Follows a mission and the truth about it, and writes down every attempt: a goal set for an egg.
/// Pure: what happens is told in order of time. The map's origin is where the robot stood when its
/// mapping began: the start pose of the world.
class Referee {
 public:
  Referee(const RefereeConfig& config, const Eigen::Vector2d& working_point);

  void begin(const world::World& world);
  void see(const world::GroundTruth& truth);
  /// Where the robot believed to be at a moment seen before or just now.
  void locate(Time stamp, const Pose2& robot_in_world, const Pose2& believed_in_map);
  void hear_goal(const std::string& goal_id);
  void hear(const NavigationView& navigation);
  void hear(const MissionView& mission);
  /// The run is over: closes what is open, and accounts for every egg that was never tried.
  void end();

  [[nodiscard]] bool has_ended() const { return ended_; }
  /// Attempts that are over, in order of their ends; each once.
  [[nodiscard]] std::vector<Attempt> take_finished();

 private:
  struct Open {
    Attempt attempt;
    std::string goal_id;
    Eigen::Vector2d believed_egg_in_map{0, 0};
    std::uint32_t collisions_before = 0;
    std::optional<Time> arrived;  ///< by the driver's word
    std::optional<NavigationView::Source> given_up_by;
  };
  void open(const MissionEgg& egg);
  void follow(const MissionEgg& egg);
  void judge_arrival();
  void close(const std::string& reason, bool mission_goes_on);
  [[nodiscard]] Cause cause_of(const Open& open, bool mission_goes_on) const;
  [[nodiscard]] const world::Egg* true_egg(const std::string& id) const;
  [[nodiscard]] std::string nearest_egg(const Eigen::Vector2d& egg_in_map) const;
  [[nodiscard]] Attempt untried(const world::Egg& egg) const;

  RefereeConfig config_;
  Eigen::Vector2d working_point_;
  std::optional<Pose2> map_in_world_;
  world::GroundTruth truth_;
  bool has_truth_ = false;
  struct Located {
    Time stamp{};
    Pose2 robot_in_world;
    Pose2 believed_in_map;
  };
  std::optional<Located> located_;
  std::string goal_id_;
  MissionView mission_;
  std::vector<std::pair<std::string, int>> tries_seen_;  ///< per egg of the mission
  std::vector<std::string> eggs_tried_;                  ///< of the world
  std::optional<Open> open_;
  std::vector<Attempt> finished_;
  bool ended_ = false;
};

}  // namespace coop::referee
