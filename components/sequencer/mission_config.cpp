#include "sequencer/mission.hpp"

namespace coop::sequencer {

void MissionConfig::describe(config::Fields& fields) {
  fields.integer("expected_eggs", expected_eggs,
                 {.help = "the search ends when as many are known; 0: all waypoints", .min = 0});
  fields.integer("max_searches", max_searches,
                 {.help = "tours while fewer eggs than expected are known", .min = 1, .max = 100});
  fields.integer("max_attempts", max_attempts,
                 {.help = "approaches to one egg", .min = 1, .max = 100});
  fields.number("goal_timeout", goal_timeout,
                {.unit = "s", .help = "for one drive", .min = 1, .max = 3600});
  fields.number("goal_repeat", goal_repeat,
                {.unit = "s", .help = "the goal is told again", .min = 0.1, .max = 60});
  fields.number("pick_repeat", pick_repeat,
                {.unit = "s", .help = "the pick is told again", .min = 0.1, .max = 60});
  fields.number("pick_timeout", pick_timeout,
                {.unit = "s", .help = "for one pick", .min = 1, .max = 600});
  fields.number("refresh_distance", refresh_distance,
                {.unit = "m", .help = "a goal that moved this much is told anew", .min = 0.001});
  fields.number("refresh_until", refresh_until,
                {.unit = "m", .help = "nearer than this the goal stays", .min = 0});
  fields.number("waypoint_radius", waypoint_radius,
                {.unit = "m", .help = "a waypoint this near is reached", .min = 0, .max = 10});
  fields.number("settle_time", settle_time,
                {.unit = "s", .help = "standing still before reach is judged", .min = 0});
  fields.flag("return_home", return_home, {.help = "drive back to where the mission began"});
}

}  // namespace coop::sequencer
