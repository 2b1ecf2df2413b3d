#include "sequencer/sequencer.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace coop::sequencer {

void WaypointConfig::describe(config::Fields& fields) {
  fields.text("name", name, {.help = "for people"});
  fields.number("x", x, {.unit = "m", .help = "in map"});
  fields.number("y", y, {.unit = "m", .help = "in map"});
  fields.number("yaw", yaw, {.unit = "rad", .help = "heading on arrival", .min = -7, .max = 7});
}

void SequencerConfig::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 4> kStarts{"none", "collect", "survey", "clean"};
  static constexpr std::array<std::string_view, 2> kMethods{"paper", "best"};
  fields.text("robot", robot, {.help = "URDF of the robot: its footprint"});
  fields.choice("autostart", autostart, kStarts, {.help = "mission begun by itself"});
  fields.choice("method", method, kMethods,
                {.help = "paper: ant colony; best: exact up to 12 eggs, MAX-MIN ants beyond"});
  fields.integer("max_together", max_together,
                 {.help = "eggs ordered together, the nearest; the others follow by nearness",
                  .min = 1,
                  .max = 1000});
  fields.list("waypoints", waypoints);
  fields.section("tracks", tracks);
  fields.section("colony", colony);
  fields.section("best", best);
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

namespace {

std::vector<Eigen::Vector2d> places_of(const std::vector<const EggTask*>& eggs) {
  std::vector<Eigen::Vector2d> places;
  places.reserve(eggs.size());
  for (const EggTask* egg : eggs) places.push_back(egg->egg_in_map);
  return places;
}

/// A stream of its own, drawn from a copy: the first one's numbers stay as they were.
OrderingStreams to_streams(RandomStream random) {
  RandomStream copy = random;
  return {random, RandomStream(copy(), "max_min_ants")};
}

EggTracksConfig tracks_of(const SequencerConfig& config, bool cleans) {
  EggTracksConfig tracks = config.tracks;
  if (cleans) tracks.name = "heap";
  return tracks;
}

ApproachConfig approach_of(const SequencerConfig& config,
                           const std::optional<Eigen::AlignedBox2d>& scraper) {
  ApproachConfig approach = config.approach;
  if (scraper) approach.distance = scraper->center().x() - approach.beyond;
  return approach;
}

}  // namespace

Sequencer::Sequencer(const SequencerConfig& config, const Footprint& footprint, RandomStream random,
                     const std::optional<Eigen::AlignedBox2d>& scraper)
    : config_(config),
      tracks_(tracks_of(config, scraper.has_value())),
      costs_(footprint, config.traversal),
      mission_(config.mission, approach_of(config, scraper), scraper),
      streams_(to_streams(random)) {}

MissionActions Sequencer::step(MissionSnapshot snapshot, Time now) {
  snapshot.tracks = &tracks_.tracks();
  snapshot.pictures = tracks_.pictures();
  MapQueries queries;
  queries.pose_cost = [&](const Pose2& pose) {
    return costs_.pose_cost(*snapshot.robot_in_map, pose);
  };
  queries.order = [this](const Pose2& robot, const std::vector<const EggTask*>& eggs) {
    return order(robot, eggs);
  };
  MissionActions actions = mission_.step(snapshot, queries, now);
  for (const std::string& id : actions.picked_eggs) tracks_.mark_picked(id, now);
  return actions;
}

void Sequencer::sort_by_cost(const Pose2& robot_in_map, std::vector<const EggTask*>& eggs) {
  const std::vector<double> costs = costs_.costs_from(robot_in_map, places_of(eggs));
  std::vector<std::size_t> nearest(eggs.size());
  std::iota(nearest.begin(), nearest.end(), std::size_t{0});
  std::ranges::stable_sort(nearest, {}, [&](std::size_t i) { return costs[i]; });
  std::vector<const EggTask*> sorted;
  sorted.reserve(eggs.size());
  for (const std::size_t i : nearest) sorted.push_back(eggs[i]);
  eggs = std::move(sorted);
}

OrderedEggs Sequencer::order(const Pose2& robot_in_map, std::vector<const EggTask*> eggs) {
  OrderedEggs result;
  if (!costs_.has_costmap()) return result;
  std::vector<const EggTask*> rest;
  if (const auto most = static_cast<std::size_t>(config_.max_together); eggs.size() > most) {
    sort_by_cost(robot_in_map, eggs);
    rest.assign(eggs.begin() + static_cast<std::ptrdiff_t>(most), eggs.end());
    eggs.resize(most);
  }
  const auto method = config_.method == "best" ? OrderingMethod::kBest : OrderingMethod::kPaper;
  const Ordering ordering = order_nodes(costs_.matrix(robot_in_map, places_of(eggs)), method,
                                        config_.colony, config_.best, streams_);
  result.cost = ordering.tour.cost;
  result.alternative_cost = ordering.alternative_cost;
  for (const std::size_t node : ordering.tour.order) result.order.push_back(eggs[node - 1]->id);
  for (const EggTask* egg : rest) result.order.push_back(egg->id);
  // No way leads there now. Last of all the mission tries them, and reports them.
  for (const std::size_t node : ordering.unreachable) result.order.push_back(eggs[node - 1]->id);
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
