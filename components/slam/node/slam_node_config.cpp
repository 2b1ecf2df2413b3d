#include "slam/node/slam_node_config.hpp"

namespace coop::slam {

void SlamNodeConfig::describe(config::Fields& fields) {
  fields.text(
      "save_path", save_path,
      {.help =
           "map and trajectory at exit: <path>.pgm, .yaml and _trajectory.txt; empty: not saved"});
  fields.integer(
      "threads", threads,
      {.help = "that share the particles; the result does not depend on it", .min = 1, .max = 64});
  fields.number("map_period", map_period,
                {.unit = "s", .help = "between maps, while they change", .min = 0.1, .max = 600});
  fields.number("transform_period", transform_period,
                {.unit = "s", .help = "between map -> odom", .min = 0.01, .max = 0.1});
  fields.number("transform_tolerance", transform_tolerance,
                {.unit = "s", .help = "map -> odom is dated ahead by", .min = 0.0, .max = 1.0});
  fields.number(
      "scan_timeout", scan_timeout,
      {.unit = "s", .help = "without a scan until degraded; 0: never", .min = 0.0, .max = 3600});
  fields.number("odometry_patience", odometry_patience,
                {.unit = "s",
                 .help = "a scan waits for its odometry; with reliable streams for ever",
                 .min = 0.1,
                 .max = 600});
  fields.text("session", session,
              {.help = "map and pose for a successor, in the run's folder; empty: none"});
  fields.number("session_period", session_period,
                {.unit = "s", .help = "between two sessions written", .min = 1.0, .max = 3600});
  fields.number("session_age", session_age,
                {.unit = "s", .help = "an older session is not used", .min = 1.0, .max = 1e7});
  fields.flag("resume", resume, {.help = "go on from the session that is there"});
  fields.section("odometry_restart", odometry_restart);
  slam.describe(fields);
}

}  // namespace coop::slam
