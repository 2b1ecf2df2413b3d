#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/places.hpp"
#include "launcher/keys/key_folder.hpp"
#include "launcher/plan.hpp"

namespace {

using namespace coop;
using namespace coop::keys;
using Clock = std::chrono::system_clock;

/// Clocks of a robot's hosts may differ by as much when keys are new.
constexpr auto kClockSkew = std::chrono::hours(1);

struct CommandLine {
  std::string launch;
  std::vector<std::string> overrides;
  std::optional<int> domain;
  std::optional<std::string> robot;
  std::filesystem::path folder;
  std::string protection = "data";
  std::vector<std::string> observers;
  std::vector<std::string> names;
  int days = 365;
};

/// A launch file's system and all who take part in it.
struct Roster {
  System system;
  std::vector<Participant> participants;
  std::filesystem::path folder;
};

Roster read_roster(const CommandLine& line) {
  const Places places = Places::of_this_program();
  std::vector<std::string> overrides = line.overrides;
  if (line.domain) overrides.push_back("domain=" + std::to_string(*line.domain));
  if (line.robot) overrides.push_back("robot=\"" + *line.robot + "\"");
  const auto launch =
      launcher::load_launch(launcher::find_launch_file(line.launch, places), overrides);
  const auto plan = launcher::make_plan(launch, places, launch.run_dir);
  Roster roster{.system = {.domain = plan.domain, .robot = plan.robot},
                .participants = {},
                .folder = line.folder.empty() ? plan.dds.keys : line.folder};
  if (roster.folder.empty()) {
    throw std::runtime_error("keys: --folder, or dds.keys in the launch file, says where to");
  }
  const auto add = [&roster](const std::string& name, Participant::Role role) {
    roster.participants.push_back({.name = name, .program = name, .role = role});
  };
  add("launcher", Participant::Role::kLauncher);
  add("person", Participant::Role::kPerson);
  for (const std::string& name : line.observers) add(name, Participant::Role::kObserver);
  if (std::ranges::find(plan.components, "record", &launcher::PlannedComponent::name) ==
      plan.components.end()) {
    add("record", Participant::Role::kComponent);  // as `coop record` joins
  }
  for (const auto& component : plan.components) {
    if (!component.sends_heartbeat) continue;
    const auto declared = std::ranges::find(launch.components, component.name,
                                            &config::Named<launcher::Component>::name);
    roster.participants.push_back({.name = component.name,
                                   .program = component.executable.filename(),
                                   .role = Participant::Role::kComponent,
                                   .lockstep = launch.lockstep,
                                   .leads_time = declared->value.time == "system"});
  }
  return roster;
}

void issue(const CommandLine& line, const KeyFolder& folder, const System& system,
           const Participant& participant) {
  const auto now = Clock::now();
  folder.issue(system, participant, now - kClockSkew, now + std::chrono::days(line.days));
}

int make(const CommandLine& line) {
  const Roster roster = read_roster(line);
  static const std::map<std::string, Protection> kLevels{{"discovery", Protection::kDiscovery},
                                                         {"data", Protection::kData},
                                                         {"all", Protection::kAll}};
  const KeyFolder folder(roster.folder, Clock::now() - kClockSkew);
  folder.write_governance(roster.system, kLevels.at(line.protection));
  int issued = 0;
  for (const Participant& participant : roster.participants) {
    if (folder.write_permissions(roster.system, participant)) continue;
    issue(line, folder, roster.system, participant);
    ++issued;
  }
  std::cout << roster.folder.string() << ": " << issued << " new keys, "
            << roster.participants.size() << " participants\n";
  return 0;
}

int rotate(const CommandLine& line) {
  const Roster roster = read_roster(line);
  const KeyFolder folder(roster.folder, Clock::now() - kClockSkew);
  for (const std::string& name : line.names) {
    if (std::ranges::find(roster.participants, name, &Participant::name) ==
        roster.participants.end()) {
      throw std::runtime_error("keys: no participant '" + name + "' in " + line.launch);
    }
  }
  for (const Participant& participant : roster.participants) {
    const bool is_wanted =
        line.names.empty() || std::ranges::find(line.names, participant.name) != line.names.end();
    if (!is_wanted) continue;
    issue(line, folder, roster.system, participant);
    std::cout << participant.name << ": new keys, in force when it starts again\n";
  }
  return 0;
}

/// Keys that were made before.
KeyFolder open_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder / "public")) {
    throw std::runtime_error("keys: " + folder.string() + " holds no keys");
  }
  return {folder, Clock::now() - kClockSkew};
}

int revoke(const CommandLine& line) {
  const KeyFolder folder = open_folder(line.folder);
  for (const std::string& name : line.names) {
    folder.revoke(name, Clock::now());
    std::cout << name << ": revoked; the others heed it when they start again\n";
  }
  return 0;
}

int list(const CommandLine& line) {
  const KeyFolder folder = open_folder(line.folder);
  for (const KeyFolder::Entry& entry : folder.entries()) {
    const double left =
        std::chrono::duration<double, std::ratio<86400>>(entry.not_after - Clock::now()).count();
    std::cout << entry.name << ": ";
    if (entry.revoked) {
      std::cout << "revoked\n";
    } else if (left < 0.0) {
      std::cout << "expired\n";
    } else {
      std::cout << "good for " << static_cast<int>(left) << " days\n";
    }
  }
  return 0;
}

void add_launch(CLI::App& verb, CommandLine& line) {
  verb.add_option("launch", line.launch, "launch file of the system")->required();
  verb.add_option("--set", line.overrides, "as for `coop up`; may be repeated")->take_all();
  verb.add_option("--domain", line.domain, "DDS domain")->check(CLI::Range(0, 232));
  verb.add_option("--robot", line.robot, "name of the robot");
  verb.add_option("--folder", line.folder, "of the keys; default: dds.keys of the launch file");
  verb.add_option("--observer", line.observers,
                  "further program that hears everything and commands nothing (a recorder)");
  verb.add_option("--days", line.days, "how long the keys are good")->check(CLI::Range(1, 3650));
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  CLI::App app{"Keys of DDS Security: who takes part in a system, with which topics", "keys"};
  app.require_subcommand(1);
  CLI::App* make_verb =
      app.add_subcommand("make", "authorities, governance, and keys for who has none");
  add_launch(*make_verb, line);
  make_verb->add_option("--protection", line.protection, "how much is encrypted")
      ->check(CLI::IsMember({"discovery", "data", "all"}));
  CLI::App* rotate_verb = app.add_subcommand("rotate", "new keys from the same authority");
  add_launch(*rotate_verb, line);
  rotate_verb->add_option("name", line.names, "whose; default: everybody's");
  CLI::App* revoke_verb = app.add_subcommand("revoke", "keys that are lost are refused");
  revoke_verb->add_option("folder", line.folder, "of the keys")->required();
  revoke_verb->add_option("name", line.names, "whose")->required();
  CLI::App* list_verb = app.add_subcommand("list", "whose keys there are, how long they are good");
  list_verb->add_option("folder", line.folder, "of the keys")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  try {
    if (*make_verb) return make(line);
    if (*rotate_verb) return rotate(line);
    return *revoke_verb ? revoke(line) : list(line);
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  }
}
