#pragma once
#include "core/config/fields.hpp"
#include "core/random.hpp"
#include "sequencer/mission.hpp"
#include "sequencer/ordering.hpp"
#include "sequencer/path_costs.hpp"

namespace coop::sequencer {

struct WaypointConfig {
  std::string name;
  double x = 0.0;    ///< m in map
  double y = 0.0;    ///< m in map
  double yaw = 0.0;  ///< rad in map

  void describe(config::Fields& fields);
};

struct SequencerConfig {
  std::string robot = "config/robot/egg_collector.urdf";
  std::string autostart = "none";  ///< none, collect, survey, clean
  std::string method = "paper";    ///< paper: ant colony; best: exact, or MAX-MIN ants
  int max_together = 100;          ///< eggs ordered together: the nearest; the others follow
  std::vector<WaypointConfig> waypoints;
  EggTracksConfig tracks;
  AntColonyConfig colony;
  MaxMinConfig best;
  ApproachConfig approach;
  MissionConfig mission;
  TraversalConfig traversal{.restricted_weight = 6.0, .unknown_weight = 3.0, .allow_unknown = true};

  void describe(config::Fields& fields);
  [[nodiscard]] std::vector<Waypoint> waypoint_list() const;
};

/// Tracks, mission and path costs joined: what the shell drives.
class Sequencer {
 public:
  /// `scraper`: the blade of a robot that cleans, in base_link, m; it is heaps then that are
  /// tracked, and approached until the blade has passed over them.
  Sequencer(const SequencerConfig& config, const Footprint& footprint, RandomStream random,
            const std::optional<Eigen::AlignedBox2d>& scraper = {});

  void see(const Picture& picture) { tracks_.update(picture); }
  void set_costmap(const OccupancyGrid& costmap) { costs_.set_costmap(costmap); }
  [[nodiscard]] bool has_costmap() const { return costs_.has_costmap(); }

  [[nodiscard]] MissionActions step(MissionSnapshot snapshot, Time now);
  [[nodiscard]] Mission& mission() { return mission_; }
  [[nodiscard]] const Mission& mission() const { return mission_; }
  [[nodiscard]] const EggTracks& tracks() const { return tracks_; }
  /// From the journal: the mission's state, and its eggs as tracks.
  void restore(const MissionState& state, Time now);

 private:
  [[nodiscard]] OrderedEggs order(const Pose2& robot_in_map, std::vector<const EggTask*> eggs);
  /// Where there are more than can be ordered together: the nearest first.
  void sort_by_cost(const Pose2& robot_in_map, std::vector<const EggTask*>& eggs);

  SequencerConfig config_;
  EggTracks tracks_;
  PathCosts costs_;
  Mission mission_;
  OrderingStreams streams_;
};

}  // namespace coop::sequencer
