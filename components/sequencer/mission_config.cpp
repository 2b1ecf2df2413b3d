#include "sequencer/mission.hpp"

namespace coop::sequencer {

void MissionConfig::describe(config::Fields& fields) {
  fields.integer("expected_eggs", expected_eggs,
                 {.help = "the search ends when as many are known; 0: all waypoints", .min = 0});
  fields.integer("max_searches", max_searches,
                 {.help = "tours while fewer eggs than expected are known", .min = 1, .max = 100});
  fields.integer("max_attempts", max_attempts,
                 {.help = "approaches to one egg", .min = 1, .max = 100});
  fields.integer("max_refusals", max_refusals,
                 {.help = "sides tried at one attempt while navigators refuse to start",
                  .min = 0,
                  .max = 100});
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
  fields.number("look_from", look_from,
                {.unit = "m", .help = "from the approach pose; the egg must be seen", .min = 0});
  fields.integer("unseen_after", unseen_after,
                 {.help = "pictures in a row without the egg: it is not there", .min = 1});
  fields.number("look_time", look_time,
                {.unit = "s", .help = "for the pictures to agree on arrival", .min = 0, .max = 60});
  fields.integer("max_looks", max_looks,
                 {.help = "approaches without a sight of the egg", .min = 1, .max = 100});
  fields.number("look_apart", look_apart,
                {.unit = "rad", .help = "between the headings of looks", .min = 0, .max = 3});
  fields.integer("seen_again_after", seen_again_after,
                 {.help = "pictures in a row with a missing egg", .min = 1, .max = 1000});
  fields.number("last_look", last_look,
                {.unit = "s", .help = "for what the arm lost, at the end", .min = 0, .max = 60});
  fields.integer("look_pictures", look_pictures,
                 {.help = "cleaning: of the pen, before the order is made", .min = 1, .max = 1000});
  fields.number("sweep_margin", sweep_margin,
                {.unit = "m", .help = "cleaning: of the blade beyond a heap's middle", .min = 0});
  fields.number("retry_pause", retry_pause,
                {.unit = "s", .help = "cleaning: until what failed is tried again", .min = 0});
  fields.flag("return_home", return_home, {.help = "drive back to where the mission began"});
}

}  // namespace coop::sequencer
