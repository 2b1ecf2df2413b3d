#include "runtime/options.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace coop::runtime {

std::optional<Options> parse_options(int argc, const char* const* argv, const std::string& name,
                                     const std::string& description, int& exit_code) {
  Options options;
  options.name = name;
  CLI::App app{description, name};
  app.option_defaults()->always_capture_default(false);
  app.add_option("--name", options.name, "name in the system (default: " + name + ")");
  app.add_option("--config", options.config, "YAML file; what it does not name keeps its default");
  app.add_option("--set", options.settings, "key=value on top of the YAML; may be repeated")
      ->take_all();
  app.add_option("--domain", options.domain, "DDS domain, 0 to 232")->check(CLI::Range(0, 232));
  app.add_option("--robot", options.robot, "robot name; robots of other names are not heard");
  app.add_option(
         "--dds", options.dds,
         "key=value: how others are found and reached (docs/hosts.md); may be repeated, goes "
         "over those in the environment's COOP_DDS: discovery, peers, peer_participants, "
         "server, lease, transport, interfaces, security, keys")
      ->take_all();
  app.add_flag("--sim-time", options.sim_time, "take the time from the topic clock");
  app.add_flag("--lockstep", options.lockstep, "run in step with all other components");
  app.add_option("--member", options.members,
                 "lockstep, the master of time: one that must join before the first tick")
      ->take_all();
  app.add_flag("--trace", options.trace,
               "lockstep: write down a hash of every sample written, in RUN_DIR/trace");
  app.add_flag("--reliable-streams", options.reliable_streams,
               "lose no sensor sample (log replay)");
  app.add_option("--seed", options.seed, "seed of all random numbers");
  app.add_option("--log-dir", options.log_dir, "folder of the JSON-lines log");
  app.add_option("--run-dir", options.run_dir, "folder of journals and results");
  app.add_flag("--verbose", options.verbose, "log at level debug");
  using Mode = Options::Mode;
  const auto mode = [&](const char* flag, Mode value, const char* help) {
    app.add_flag_callback(
        flag, [&options, value] { options.mode = value; }, help);
  };
  mode("--check", Mode::kCheck, "check the configuration and exit");
  mode("--print-config", Mode::kPrintConfig, "print the configuration in force as YAML and exit");
  mode("--print-table", Mode::kPrintTable, "print the table of all keys as Markdown and exit");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    exit_code = app.exit(wanted);
    return std::nullopt;
  } catch (const CLI::ParseError& problem) {
    std::cerr << name << ": " << problem.what() << " (see --help)\n";
    exit_code = 2;
    return std::nullopt;
  }
  return options;
}

}  // namespace coop::runtime
