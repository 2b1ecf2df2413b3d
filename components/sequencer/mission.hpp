#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/config/fields.hpp"
#include "core/time.hpp"
#include "sequencer/approach.hpp"
#include "sequencer/egg_tracks.hpp"
#include "sequencer/mission_state.hpp"

namespace coop::sequencer {

struct MissionConfig {
  int expected_eggs = 0;  ///< the search ends when as many are known; 0: all waypoints
  int max_searches = 2;   ///< tours of the waypoints while fewer eggs than expected are known
  int max_attempts = 4;   ///< approaches to one egg before it is reported as failed
  int max_refusals = 4;   ///< sides of an egg tried at one attempt while navigators refuse to start
  double goal_timeout = 150.0;     ///< s for one drive
  double goal_repeat = 2.0;        ///< s, the goal is told again, for planners that restarted
  double pick_repeat = 3.0;        ///< s, the pick is told again under its id
  double pick_timeout = 60.0;      ///< s for one pick
  double refresh_distance = 0.04;  ///< m, an approach pose that moved this much is told anew
  double refresh_until = 0.5;      ///< m from the goal; nearer it stays as it is
  double waypoint_radius = 0.6;    ///< m, a waypoint this near is reached: the robot drives on
  double settle_time = 0.5;        ///< s of standing still before reach is judged
  double look_from = 0.6;          ///< m from the approach pose; from there the egg must be seen
  int unseen_after = 6;            ///< pictures in a row without the egg: it is not there
  double look_time = 2.0;          ///< s of standing before the egg until the pictures must agree
  int max_looks = 2;               ///< approaches without a sight of the egg, then it is missing
  double look_apart = 1.0;         ///< rad between the headings of two looks
  int seen_again_after = 3;        ///< pictures in a row with a missing egg: it is there again
  double last_look = 1.5;          ///< s for what the arm lost to be seen, before the mission ends
  bool return_home = false;        ///< drive back to where the mission began
  int look_pictures = 10;          ///< cleaning: of the pen, before the order is made
  double sweep_margin =
      0.09;                  ///< m, cleaning: by which the blade must reach beyond a heap's middle
  double retry_pause = 5.0;  ///< s, cleaning: of standing until what failed is tried again

  void describe(config::Fields& fields);
};

/// What the navigators say of a goal.
struct NavigationReport {
  enum class State { kUnderWay, kArrived, kFailed };
  std::string goal_id;
  State state = State::kUnderWay;
  std::string reason;  ///< of a failure
};

struct PickReport {
  std::string pick_id;
  bool picked = false;
  bool is_final = true;  ///< false: try the same pick again (the arm is busy)
  std::string reason;
};

/// An order of the eggs named, and what it costs.
struct OrderedEggs {
  std::vector<std::string> order;
  double cost = 0.0;
  double alternative_cost = 0.0;
};

/// What the mission asks of the map. Given with every step, so that the mission itself stays pure.
struct MapQueries {
  PoseCost pose_cost;
  std::function<OrderedEggs(const Pose2& robot, const std::vector<const EggTask*>& eggs)> order;
};

/// Everything the mission sees at one time.
struct MissionSnapshot {
  std::optional<Pose2> robot_in_map;
  double speed = 0.0;                          ///< m/s
  std::optional<NavigationReport> navigation;  ///< the last word on the present goal
  std::optional<PickReport> pick;              ///< the last word on the present pick
  const std::vector<EggTrack>* tracks = nullptr;
  int pictures = 0;  ///< looked at so far
};

struct GoalOrder {
  std::string goal_id;
  Pose2 pose_in_map;
};

struct PickOrder {
  std::string pick_id;
  std::string egg_id;
  Eigen::Vector2d egg_in_map{0, 0};
};

/// What the shell is to do, in this order: journal, then goal and pick.
struct MissionActions {
  bool state_changed = false;  ///< write the state to the journal before anything else is done
  std::optional<GoalOrder> goal;
  std::optional<std::string> take_back;  ///< id of a goal: the navigators are to stop
  std::optional<PickOrder> pick;
  std::vector<std::string> picked_eggs;  ///< tell the tracks
};

struct MissionRules;

/// The mission as a pure state machine: no clock, no topics. Goals and picks are told again until
/// they are answered, so that the death of any other process only delays. Where the robot is to
/// stand (paused, aborted, at the end), the goal told last is taken back until the navigators
/// answer. A state restored from the journal goes on where it was: an egg being picked is asked for
/// again under the same pick id, which the arm answers once and for all.
class Mission {
 public:
  /// `scraper`: the blade of a robot that cleans, in base_link, m.
  Mission(const MissionConfig& config, const ApproachConfig& approach,
          const std::optional<Eigen::AlignedBox2d>& scraper = {})
      : config_(config), approach_(approach), scraper_(scraper) {}

  void start(MissionKind kind, const std::string& mission_id, std::vector<Waypoint> waypoints);
  void pause();
  void resume();
  void abort(const std::string& reason);
  /// From the journal.
  void restore(MissionState state) { state_ = std::move(state); }

  [[nodiscard]] MissionActions step(const MissionSnapshot& snapshot, const MapQueries& queries,
                                    Time now);

  [[nodiscard]] const MissionState& state() const { return state_; }

 private:
  struct Drive {
    GoalOrder goal;
    Pose2 from_in_map;
    Time begun{};
    Time told{};
  };

  [[nodiscard]] const MissionRules& rules() const;

  void adopt_eggs(const MissionSnapshot& snapshot);
  void step_waypoints(const MissionSnapshot& snapshot, Time now);
  void step_ordering(const MissionSnapshot& snapshot, const MapQueries& queries, Time now);
  void step_approach(const MissionSnapshot& snapshot, const MapQueries& queries, Time now);
  void step_picking(const MissionSnapshot& snapshot, Time now);
  void step_returning(const MissionSnapshot& snapshot, Time now);
  void begin_approach(const MissionSnapshot& snapshot, const MapQueries& queries, Time now);
  void refresh_goal(const MissionSnapshot& snapshot, const EggTask& egg, const MapQueries& queries);
  [[nodiscard]] bool try_another_side(const MissionSnapshot& snapshot, EggTask& egg);
  void attempt_failed(EggTask& egg, const std::string& reason);
  void enter(MissionPhase phase, const std::string& detail);
  void drive_to(const Pose2& pose, const MissionSnapshot& snapshot, Time now);
  void repeat_goal(Time now);
  void note_end_of_goal(const MissionSnapshot& snapshot);
  void take_goal_back(Time now);
  /// The navigators' answer to the present goal, a time-out included.
  [[nodiscard]] NavigationReport drive_result(const MissionSnapshot& snapshot, Time now) const;

  // What MissionRules chooses from. Of kinds with nothing of their own:
  void look_on(const MissionSnapshot& snapshot);
  [[nodiscard]] bool knows_nothing() const;
  [[nodiscard]] bool waits_never(const std::vector<const EggTask*>& put_off, Time now);
  [[nodiscard]] bool drives_on(const MissionSnapshot& snapshot, EggTask& target);
  void end_survey(const MissionSnapshot& snapshot);

  // Of collections.
  [[nodiscard]] bool knows_expected_eggs() const;
  void order_eggs(const MissionSnapshot& snapshot);
  [[nodiscard]] bool looks_in_vain(const MissionSnapshot& snapshot, EggTask& egg);
  void step_arrival(const MissionSnapshot& snapshot, Time now);
  void end_or_search_again(Time now);
  void egg_picked(EggTask& egg);
  void note_late_pick(const MissionSnapshot& snapshot);
  void egg_not_seen(EggTask& egg);
  /// Pictures in a row, taken from near the approach pose, that lack the egg.
  [[nodiscard]] int pictures_without(const MissionSnapshot& snapshot, const EggTask& egg);

  // Of cleaning.
  void order_heaps(const MissionSnapshot& snapshot);
  void note_swept(const MissionSnapshot& snapshot);
  [[nodiscard]] bool waits_for_pigs(const std::vector<const EggTask*>& put_off, Time now);
  void step_beside_heap(const MissionSnapshot& snapshot, Time now);
  void go_home_and_look(Time now);
  void look_back();

  [[nodiscard]] int known_eggs() const;  ///< those that turned out missing left out
  [[nodiscard]] bool wants_another_search() const;
  void search_again();
  void finish();

  MissionConfig config_;
  ApproachConfig approach_;
  std::optional<Eigen::AlignedBox2d> scraper_;
  MissionState state_;
  MissionActions actions_;
  std::optional<Drive> drive_;
  std::optional<Time> arrived_;
  int refusals_ = 0;       ///< at this attempt
  int unseen_before_ = 0;  ///< pictures in a row without the egg, of before this look
  std::optional<Time> last_look_;
  Time taken_back_{};  ///< when the goal was taken back last
  std::optional<Time> pick_begun_;
  Time pick_told_{};
  std::optional<Time> waiting_since_;               ///< until what failed is tried again
  std::optional<int> pictures_before_;              ///< the look at the pen
  std::optional<Pose2> observed_from_;              ///< where the robot was at the last step
  std::unordered_set<std::string> ahead_of_blade_;  ///< heaps, at the last step
  bool is_home_ = false;
  bool changed_ = false;
};

}  // namespace coop::sequencer
