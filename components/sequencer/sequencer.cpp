#include "sequencer/sequencer.hpp"

#include <array>

#include "sequencer/held_karp.hpp"

namespace coop::sequencer {

void WaypointConfig::describe(config::Fields& fields) {
  fields.text("name", name, {.help = "for people"});
  fields.number("x", x, {.unit = "m", .help = "in map"});
  fields.number("y", y, {.unit = "m", .help = "in map"});
  fields.number("yaw", yaw, {.unit = "rad", .help = "heading on arrival", .min = -7, .max = 7});
}

void SequencerConfig::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kStarts{"none", "collect", "survey"};
  static constexpr std::array<std::string_view, 2> kMethods{"paper", "best"};
  fields.text("robot", robot, {.help = "URDF of the robot: its footprint"});
  fields.choice("autostart", autostart, kStarts, {.help = "mission begun by itself"});
  fields.choice("method", method, kMethods,
                {.help = "paper: ant colony; best: exact up to 12 eggs, ant colony beyond"});
  fields.list("waypoints", waypoints);
  fields.section("tracks", tracks);
  fields.section("colony", colony);
  fields.section("approach", approach);
  fields.section("mission", mission);
  fields.section("traversal", traversal);
}

std::vector<Waypoint> SequencerConfig::waypoint_list() const {
  std::vector<Waypoint> list;
  for (const WaypointConfig& waypoint : waypoints) {
    const std::string name =
        waypoint.name.empty() ? "waypoint " + std::to_string(list.size() + 1) : waypoint.name;
    list.push_back({name, {waypoint.x, waypoint.y, waypoint.yaw}});
  }
  return list;
}

Sequencer::Sequencer(const SequencerConfig& config, const Footprint& footprint, RandomStream random)
    : config_(config),
      tracks_(config.tracks),
      costs_(footprint, config.traversal),
      mission_(config.mission, config.approach),
      random_(random) {}

MissionActions Sequencer::step(MissionSnapshot snapshot, Time now) {
  snapshot.tracks = &tracks_.tracks();
  MapQueries queries;
  queries.pose_cost = [&](const Pose2& pose) {
    return costs_.pose_cost(*snapshot.robot_in_map, pose);
  };
  queries.order = [this](const Pose2& robot, const std::vector<const EggTask*>& eggs) {
    return order(robot, eggs);
  };
  MissionActions actions = mission_.step(snapshot, queries, now);
  if (actions.picked_egg) tracks_.mark_picked(*actions.picked_egg, now);
  return actions;
}

OrderedEggs Sequencer::order(const Pose2& robot_in_map, const std::vector<const EggTask*>& eggs) {
  OrderedEggs result;
  if (!costs_.has_costmap()) return result;
  std::vector<Eigen::Vector2d> places;
  for (const EggTask* egg : eggs) places.push_back(egg->egg_in_map);
  const CostMatrix matrix = costs_.matrix(robot_in_map, places);
  Tour tour = solve_by_ant_colony(matrix, config_.colony, random_);
  result.alternative_cost = 0.0;
  if (eggs.size() <= kMaxExactTargets) {
    Tour exact = solve_exactly(matrix, config_.colony.closed);
    result.alternative_cost = exact.cost;
    if (config_.method == "best") {
      result.alternative_cost = tour.cost;
      tour = std::move(exact);
    }
  }
  result.cost = tour.cost;
  for (const std::size_t node : tour.order) result.order.push_back(eggs[node - 1]->id);
  return result;
}

void Sequencer::restore(const MissionState& state, Time now) {
  mission_.restore(state);
  for (const EggTask& egg : state.eggs) {
    EggTrack track;
    track.id = egg.id;
    track.egg_in_map = egg.egg_in_map;
    track.covariance = 0.05 * 0.05 * Eigen::Matrix2d::Identity();
    track.sightings = 1;
    track.last_seen = now;
    track.picked = egg.phase == EggPhase::kPicked;
    track.picked_at = now;
    tracks_.restore(std::move(track));
  }
}

}  // namespace coop::sequencer
