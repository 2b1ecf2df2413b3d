#include "dwa/config.hpp"

#include <array>

namespace coop::dwa {

void CriticConfig::describe(config::Fields& fields) {
  fields.number("alpha", alpha, {.help = "weight of head, equation 10", .min = 0, .max = 100});
  fields.number("beta", beta, {.help = "weight of dist, equation 10", .min = 0, .max = 100});
  fields.number("gamma", gamma, {.help = "weight of velocity, equation 10", .min = 0, .max = 100});
  fields.number(
      "path_weight", path_weight,
      {.help = "weight of the error along the plan; not in the paper", .min = 0, .max = 1000});
  fields.number(
      "path_scale", path_scale,
      {.unit = "m", .help = "an error of this size costs path_weight", .min = 0.001, .max = 10});
  fields.number("heading_arm", heading_arm,
                {.unit = "m",
                 .help = "a heading error counts as an error on an arm of this length",
                 .min = 0,
                 .max = 10});
  fields.number(
      "match_distance", match_distance,
      {.unit = "m", .help = "piece of plan a trajectory is compared with", .min = 0.1, .max = 5});
  fields.number("target_distance", target_distance,
                {.unit = "m",
                 .help = "head's target lies this far beyond the trajectories",
                 .min = 0.1,
                 .max = 10});
  fields.number("max_obstacle_distance", max_obstacle_distance,
                {.unit = "m", .help = "dist does not grow beyond", .min = 0.1, .max = 10});
}

void WindowConfig::describe(config::Fields& fields) {
  fields.number("window_time", window_time,
                {.unit = "s",
                 .help = "velocities reachable in this time are sampled",
                 .min = 0.01,
                 .max = 5});
  fields.integer("speed_samples", speed_samples,
                 {.help = "m + 1 in equation 7", .min = 1, .max = 100});
  fields.integer("steering_samples", steering_samples,
                 {.help = "n + 1 in equation 7", .min = 1, .max = 200});
}

void PredictionConfig::describe(config::Fields& fields) {
  fields.number("prediction_time", prediction_time,
                {.unit = "s", .help = "length of the trajectories", .min = 0.1, .max = 10});
  fields.number("prediction_step", prediction_step,
                {.unit = "s", .help = "between their poses", .min = 0.01, .max = 1});
  fields.number(
      "padding", padding,
      {.unit = "m", .help = "around the footprint that must stay free", .min = 0, .max = 1});
}

void SpeedConfig::describe(config::Fields& fields) {
  fields.number("acceleration", acceleration,
                {.unit = "m/s^2", .help = "of the base, both ways", .min = 0.01, .max = 10});
  fields.number(
      "braking", braking,
      {.unit = "m/s^2", .help = "planned for stopping at a point", .min = 0.01, .max = 10});
  fields.number("max_lateral_acceleration", max_lateral_acceleration,
                {.unit = "m/s^2", .help = "in bends", .min = 0.01, .max = 10});
  fields.number(
      "creep_speed", creep_speed,
      {.unit = "m/s", .help = "slowest on the way to a stopping point", .min = 0.005, .max = 0.5});
  fields.number(
      "narrow_clearance", narrow_clearance,
      {.unit = "m", .help = "with less free space beside the robot slower", .min = 0.01, .max = 5});
  fields.number(
      "narrow_speed", narrow_speed,
      {.unit = "m/s", .help = "with no free space beside the robot", .min = 0.01, .max = 5});
}

void ArrivalConfig::describe(config::Fields& fields) {
  fields.number("stop_distance", stop_distance,
                {.unit = "m",
                 .help = "before a stopping point at which the base is told to stop",
                 .min = 0,
                 .max = 0.2});
  fields.number("along_tolerance", along_tolerance,
                {.unit = "m", .help = "at the goal, along its heading", .min = 0.005, .max = 1});
  fields.number(
      "lateral_tolerance", lateral_tolerance,
      {.unit = "m", .help = "at the goal, of the point `reach` ahead", .min = 0.005, .max = 1});
  fields.number(
      "reach", reach,
      {.unit = "m", .help = "the arm's working point ahead of base_link", .min = 0, .max = 5});
}

void RecoveryConfig::describe(config::Fields& fields) {
  fields.number("input_timeout", input_timeout,
                {.unit = "s",
                 .help = "odometry or a scan older than this stops the base",
                 .min = 0.05,
                 .max = 10});
  fields.number("transform_timeout", transform_timeout,
                {.unit = "s",
                 .help = "so long after the time it was dated ahead for, the transform map -> odom "
                         "stops the base",
                 .min = 0.02,
                 .max = 10});
  fields.number(
      "blocked_time", blocked_time,
      {.unit = "s", .help = "blocked so long, a new plan is asked for", .min = 0, .max = 60});
  fields.number("patience", patience,
                {.unit = "s", .help = "blocked so long, the base backs up", .min = 0, .max = 600});
  fields.number("back_up_distance", back_up_distance,
                {.unit = "m", .help = "along the track it came on", .min = 0, .max = 3});
  fields.number("give_up_time", give_up_time,
                {.unit = "s",
                 .help = "without progress before the goal is reported stuck",
                 .min = 1,
                 .max = 3600});
  fields.integer("max_back_ups", max_back_ups, {.help = "for one goal", .min = 0, .max = 100});
}

void LocalMapConfig::describe(config::Fields& fields) {
  fields.number("size", size,
                {.unit = "m", .help = "edge of the square around the robot", .min = 3, .max = 30});
  fields.number("resolution", resolution,
                {.unit = "m", .help = "edge of a cell", .min = 0.01, .max = 0.2});
  fields.number("static_tolerance", static_tolerance,
                {.unit = "m",
                 .help = "an obstacle of the map this close to one that was seen is that one",
                 .min = 0,
                 .max = 1});
  fields.flag("use_map", use_map,
              {.help = "obstacles of the static map where the laser has not looked"});
  fields.integer(
      "occupied_from", occupied_from,
      {.unit = "%", .help = "map cells from here on are obstacles", .min = 1, .max = 100});
  fields.section("inflation", inflation);
  fields.section("obstacles", obstacles);
}

void AnimalCheckConfig::describe(config::Fields& fields) {
  fields.flag("use", use, {.help = "whether a camera above tells where animals are"});
  fields.number("horizon", horizon,
                {.unit = "s",
                 .help = "trajectories are checked against walking animals so far ahead",
                 .min = 0,
                 .max = 10});
  AnimalTracksConfig::describe(fields);
}

void DwaConfig::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 2> kModes{"aligned", "paper"};
  fields.choice("mode", mode, kModes,
                {.help = "aligned: the paper's terms and the error along the plan; paper: "
                         "equations 5 to 10 alone"});
  fields.number("max_vel_x", speed.max_vel_x,
                {.unit = "m/s", .help = "fastest forwards", .min = 0.01, .max = 5});
  fields.number("max_reverse", speed.max_reverse,
                {.unit = "m/s", .help = "fastest backwards", .min = 0.01, .max = 5});
  fields.number("control_period", control_period,
                {.unit = "s", .help = "between two commands", .min = 0.01, .max = 0.25});
  fields.section("speed", speed);
  fields.section("window", window);
  fields.section("prediction", prediction);
  fields.section("critic", critic);
  fields.section("arrival", arrival);
  fields.section("recovery", recovery);
  fields.section("local_map", local_map);
  fields.section("animals", animals);
}

}  // namespace coop::dwa
