#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.hpp"
#include "core/places.hpp"
#include "runtime/dds_settings.hpp"

namespace coop::launcher {

/// What becomes of a component that ends without having been asked to.
struct RestartPolicy {
  std::string policy = "on-failure";  ///< always (also after exit code 0), on-failure, never
  double min_backoff = 0.1;           ///< s, pause before the first restart; doubles with each
  double max_backoff = 5.0;           ///< s
  int give_up_after = 5;              ///< failures within `within` after which it stays down
  double within = 30.0;               ///< s

  void describe(config::Fields& fields);
};

/// Where a component's output goes besides RUN_DIR/logs/NAME.log, and how large that file may get.
struct LogSettings {
  bool console = false;    ///< show each line on the launcher's terminal as well
  double max_size = 20.0;  ///< MB, then the file is rotated
  int keep = 3;            ///< rotated files kept

  void describe(config::Fields& fields);
};

/// One process of the system, as the launch file declares it.
struct Component {
  bool enabled = true;
  std::string executable;                      ///< empty: the component's name
  std::string config;                          ///< empty: config/<executable>.yaml where it exists
  std::vector<config::Assignment> parameters;  ///< on top of the configuration file
  std::vector<std::string> arguments;  ///< further command line arguments, passed as they are
  std::vector<std::string> after;      ///< started when these are up
  std::string after_where;
  RestartPolicy restart;
  std::vector<config::Assignment> dds;  ///< on top of the launch's dds
  std::string dds_where;
  std::vector<config::Assignment> environment;
  LogSettings log;
  std::string health = "heartbeat";  ///< none: a program that sends no component_status
  double start_timeout = 15.0;       ///< s, from start to ready
  double heartbeat_timeout = 3.0;    ///< s without heartbeat: the process hangs
  double stop_timeout = 3.0;         ///< s, from SIGTERM to SIGKILL
  std::string time = "as_launch";    ///< system: despite use_sim_time, for the master of time
  std::string on_exit = "ignore";    ///< shutdown: its end with exit code 0 ends the system
  bool required = true;              ///< the system stops when this one is given up

  void describe(config::Fields& fields);
};

/// Settings of the middleware, for every component and the launcher itself.
struct DdsSettings : runtime::DdsSettings {
  std::string profiles;  ///< XML profile file for Fast DDS

  void describe(config::Fields& fields);
};

/// A launch file: which components make up a robot, and what holds for all of them.
struct Launch {
  std::vector<std::string> include;  ///< read before this file; relative to it
  std::string robot;                 ///< DDS partition; empty: none, as ROS 2
  int domain = 0;
  bool use_sim_time = false;
  bool lockstep = false;  ///< every component runs its ticks in step with all others
  bool trace = false;     ///< lockstep: a hash of every sample, in the run's folder
  bool reliable_streams = false;
  std::int64_t seed = 1;
  std::string run_dir = "runs";  ///< each run gets a folder of its own in it
  DdsSettings dds;
  std::string dds_where;
  std::vector<config::Assignment> variables;  ///< ${name} in every text of the file
  Component defaults;                         ///< what components start from that come after it
  std::vector<config::Named<Component>> components;

  void describe(config::Fields& fields);

  std::filesystem::path file;  ///< the file this was read from
};

/// A path, or the name of a launch file that comes with Coop: config/launch/sim.yaml, sim.yaml,
/// sim. Throws config::Error where there is none.
[[nodiscard]] std::filesystem::path find_launch_file(const std::filesystem::path& wanted,
                                                     const Places& places);

/// Reads `path` with everything it includes, strictly, then the overrides:
/// `component.parameter=value`, `variable=value` or `launch_key=value`. Variables are not replaced
/// yet. Throws config::Error.
[[nodiscard]] Launch load_launch(const std::filesystem::path& path,
                                 const std::vector<std::string>& overrides);

}  // namespace coop::launcher
