#include <CLI/CLI.hpp>
#include <iostream>

#include "launcher/commands.hpp"
#include "launcher/session.hpp"

namespace {

using coop::launcher::SystemChoice;
using coop::launcher::UpOptions;

struct CommandLine {
  UpOptions up;
  SystemChoice choice;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> run_dir;
  std::string component;
  std::string override_name;
  bool json = false;
  bool follow = false;
  std::size_t lines = 200;
};

void add_choice(CLI::App& verb, CommandLine& line) {
  verb.add_option("--domain", line.choice.domain, "DDS domain")->check(CLI::Range(0, 232));
  verb.add_option("--robot", line.choice.robot, "name of the robot");
}

void add_launch(CLI::App& verb, CommandLine& line) {
  verb.add_option("file", line.up.file, "launch file")->required();
  verb.add_option("--set", line.up.overrides,
                  "component.parameter=value, variable=value or launch_key=value; may be repeated")
      ->take_all();
  verb.add_option("--seed", line.seed, "root of every random number");
  add_choice(verb, line);
}

CLI::App* add_component_verb(CLI::App& app, CommandLine& line, const char* name, const char* what) {
  CLI::App* verb = app.add_subcommand(name, what);
  verb->add_option("component", line.component, "name of the component")->required();
  add_choice(*verb, line);
  return verb;
}

/// The options that stand for a launch key are overrides like all others.
UpOptions with_overrides(const CommandLine& line) {
  UpOptions up = line.up;
  if (line.choice.domain) up.overrides.push_back("domain=" + std::to_string(*line.choice.domain));
  if (line.choice.robot) up.overrides.push_back("robot=\"" + *line.choice.robot + "\"");
  if (line.seed) up.overrides.push_back("seed=" + std::to_string(*line.seed));
  if (line.run_dir) up.overrides.push_back("run_dir=" + *line.run_dir);
  return up;
}

int bring_up(const CommandLine& line) {
  const auto outcome = coop::launcher::run_system(with_overrides(line));
  if (outcome.code != 0) std::cerr << "launcher: " << outcome.reason << '\n';
  return outcome.code;
}

int run_verb(const CLI::App& app, const CommandLine& line) {
  using namespace coop::launcher;
  if (app.got_subcommand("up")) return bring_up(line);
  if (app.got_subcommand("check")) {
    check_system(with_overrides(line));
    return 0;
  }
  if (app.got_subcommand("compose")) {
    std::cout << compose_system(with_overrides(line), line.override_name);
    return 0;
  }
  if (app.got_subcommand("ps")) return show_processes(line.choice, line.json);
  if (app.got_subcommand("down")) return take_down(line.choice);
  if (app.got_subcommand("logs")) {
    return show_log(line.choice, line.component, line.run_dir.value_or("runs"), line.lines,
                    line.follow);
  }
  for (const char* verb : {"restart", "stop", "start"}) {
    if (app.got_subcommand(verb)) return control_component(line.choice, verb, line.component);
  }
  return kExitBadLaunch;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  CLI::App app{"Brings up the components of a launch file, watches over them, and stops them",
               "launcher"};
  app.require_subcommand(1);
  CLI::App* up = app.add_subcommand("up", "start a system and stay with it until it ends");
  add_launch(*up, line);
  up->add_option("--until", line.up.until, "stop by itself then")
      ->check(CLI::IsMember({"ready", "mission-done"}));
  up->add_option("--timeout", line.up.timeout, "s; stop then with exit code 5")
      ->check(CLI::PositiveNumber);
  up->add_option("--run-dir", line.run_dir, "folder that gets the folder of this run");
  up->add_flag("--quiet", line.up.quiet, "print only what goes wrong");
  add_launch(*app.add_subcommand("check", "check a launch file and every configuration it names"),
             line);
  CLI::App* compose = app.add_subcommand("compose", "print the system as a Compose file");
  add_launch(*compose, line);
  compose->add_option("--override", line.override_name, "print this override of it instead")
      ->check(CLI::IsMember({"host", "security", "hardware"}));
  CLI::App* ps = app.add_subcommand("ps", "components of the running system");
  ps->add_flag("--json", line.json, "as one line of JSON");
  add_choice(*ps, line);
  add_component_verb(app, line, "restart", "restart one component, leaving the others alone");
  add_component_verb(app, line, "stop", "stop one component");
  add_component_verb(app, line, "start", "start a stopped component");
  add_choice(*app.add_subcommand("down", "stop the running system"), line);
  CLI::App* logs =
      add_component_verb(app, line, "logs", "what a component has printed (launcher: events)");
  logs->add_flag("-f,--follow", line.follow, "and what comes");
  logs->add_option("-n,--lines", line.lines, "how many lines; 0: all");
  logs->add_option("--run-dir", line.run_dir, "folder of the runs, where no system runs");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : coop::launcher::kExitBadLaunch;
  }
  try {
    return run_verb(app, line);
  } catch (const coop::launcher::InUse& problem) {
    std::cerr << "launcher: " << problem.what() << '\n';
    return coop::launcher::kExitInUse;
  } catch (const std::exception& problem) {
    std::cerr << "launcher: " << problem.what() << '\n';
    return coop::launcher::kExitBadLaunch;
  }
}
