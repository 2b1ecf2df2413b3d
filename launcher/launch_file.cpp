#include "launcher/launch_file.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace coop::launcher {
namespace {

/// Deeper than any sensible composition; a file that includes itself is reported long before the
/// stack ends.
constexpr std::size_t kMaxIncludeDepth = 16;

void read_file(const std::filesystem::path& path, std::vector<std::filesystem::path>& open,
               Launch& launch, const std::vector<std::string>& overrides) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, error);
  if (std::ranges::find(open, canonical) != open.end() || open.size() > kMaxIncludeDepth) {
    throw config::Error(open.back().string() + ": include: " + path.string() +
                        " includes itself, directly or through others");
  }
  config::Document document = config::Document::load(path);
  const auto alone = document.read<Launch>();
  open.push_back(canonical);
  for (const std::string& include : alone.include) {
    read_file(path.parent_path() / include, open, launch, {});
  }
  open.pop_back();
  for (const std::string& assignment : overrides) document.set(assignment);
  document.read(launch);
}

Launch read(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  Launch launch;
  std::vector<std::filesystem::path> open;
  read_file(path, open, launch, overrides);
  launch.file = path;
  return launch;
}

const std::vector<std::string>& launch_keys() {
  static const std::vector<std::string> keys{
      "robot", "domain",  "use_sim_time", "lockstep",  "trace",    "reliable_streams",
      "seed",  "run_dir", "dds",          "variables", "defaults", "components"};
  return keys;
}

/// `dwa.max_vel_x=1` stands for `components.dwa.parameters.max_vel_x=1`, `map=x` for
/// `variables.map=x`.
std::string in_full(const Launch& launch, const std::string& assignment) {
  const std::size_t end = assignment.find_first_of(".=");
  const std::string first = assignment.substr(0, end);
  const bool dotted = end != std::string::npos && assignment[end] == '.';
  std::vector<std::string> names = launch_keys();
  for (const auto& component : launch.components) {
    if (component.name == first && dotted) {
      return "components." + first + ".parameters" + assignment.substr(end);
    }
    names.push_back(component.name);
  }
  for (const auto& variable : launch.variables) {
    if (variable.key == first) return "variables." + assignment;
    names.push_back(variable.key);
  }
  if (std::ranges::find(launch_keys(), first) != launch_keys().end()) return assignment;
  const std::string_view near = config::nearest_name(first, names);
  throw config::Error("--set " + assignment + ": no component, variable or launch key '" + first +
                      "'" + (near.empty() ? "" : "; did you mean '" + std::string(near) + "'?"));
}

}  // namespace

void RestartPolicy::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 3> kPolicies{"always", "on-failure", "never"};
  fields.choice("policy", policy, kPolicies, {.help = "always: also after exit code 0"});
  fields.number(
      "min_backoff", min_backoff,
      {.unit = "s", .help = "pause before the first restart; doubles", .min = 0, .max = 3600});
  fields.number("max_backoff", max_backoff,
                {.unit = "s", .help = "longest pause", .min = 0, .max = 3600});
  fields.integer(
      "give_up_after", give_up_after,
      {.help = "failures within `within` after which it stays down", .min = 1, .max = 1000});
  fields.number("within", within,
                {.unit = "s", .help = "see give_up_after", .min = 0, .max = 86400});
}

void LogSettings::describe(config::Fields& fields) {
  fields.flag("console", console, {.help = "show each line on the launcher's terminal as well"});
  fields.number("max_size", max_size,
                {.unit = "MB", .help = "larger files are rotated", .min = 0.001, .max = 10000});
  fields.integer("keep", keep, {.help = "rotated files kept", .min = 0, .max = 100});
}

void Component::describe(config::Fields& fields) {
  static constexpr std::array<std::string_view, 2> kHealth{"heartbeat", "none"};
  static constexpr std::array<std::string_view, 2> kTime{"as_launch", "system"};
  static constexpr std::array<std::string_view, 2> kOnExit{"ignore", "shutdown"};
  fields.flag("enabled", enabled, {.help = "false: declared, but not part of the system"});
  fields.text("executable", executable, {.help = "program; default: the component's name"});
  fields.text("config", config,
              {.help = "file; default: config/<executable>.yaml where it exists"});
  fields.assignments("parameters", parameters, {.help = "override the configuration file"});
  fields.texts("arguments", arguments, {.help = "further command line arguments"});
  fields.texts("after", after, {.help = "started when these components are up"});
  if (std::string place = fields.where("after"); !place.empty()) after_where = std::move(place);
  fields.section("restart", restart);
  fields.assignments("dds", dds, {.help = "override the launch file's dds"});
  if (std::string place = fields.where("dds"); !place.empty()) dds_where = std::move(place);
  fields.assignments("environment", environment, {.help = "variables of the process"});
  fields.section("log", log);
  fields.choice("health", health, kHealth, {.help = "none: the program sends no component_status"});
  fields.number("start_timeout", start_timeout,
                {.unit = "s", .help = "from start to ready", .min = 0.01, .max = 3600});
  fields.number("heartbeat_timeout", heartbeat_timeout,
                {.unit = "s", .help = "silence that counts as a hang", .min = 0.01, .max = 3600});
  fields.number("stop_timeout", stop_timeout,
                {.unit = "s", .help = "from SIGTERM to SIGKILL", .min = 0, .max = 3600});
  fields.choice("time", time, kTime, {.help = "system: despite use_sim_time (master of time)"});
  fields.choice("on_exit", on_exit, kOnExit,
                {.help = "shutdown: its end with exit code 0 ends the system"});
  fields.flag("required", required, {.help = "the system stops when it is given up"});
}

void DdsSettings::describe(config::Fields& fields) {
  runtime::DdsSettings::describe(fields);
  fields.text("profiles", profiles, {.help = "XML profile file for Fast DDS"});
}

void Launch::describe(config::Fields& fields) {
  fields.texts("include", include, {.help = "launch files read first, relative to this one"});
  fields.text("robot", robot,
              {.help = "name of the robot, its DDS partition; empty: none, as ROS 2"});
  fields.integer("domain", domain, {.help = "DDS domain", .min = 0, .max = 232});
  fields.flag("use_sim_time", use_sim_time, {.help = "time comes from the topic clock"});
  fields.flag("lockstep", lockstep,
              {.help = "time goes on when every component is done with the tick before"});
  fields.flag("trace", trace, {.help = "lockstep: a hash of every sample, in the run's folder"});
  fields.flag("reliable_streams", reliable_streams, {.help = "sensor streams lose no sample"});
  fields.integer("seed", seed, {.help = "root of every random number", .min = 0, .max = 9e15});
  fields.text("run_dir", run_dir, {.help = "each run gets a folder in it"});
  fields.section("dds", dds);
  if (std::string place = fields.where("dds"); !place.empty()) dds_where = std::move(place);
  fields.assignments("variables", variables, {.help = "${name} in every text of the file"});
  fields.section("defaults", defaults);
  fields.mapping("components", components, defaults);
}

std::filesystem::path find_launch_file(const std::filesystem::path& wanted, const Places& places) {
  const std::filesystem::path shipped = places.share / "config" / "launch";
  auto file = find_file(wanted, {".", places.share, shipped});
  if (file.empty() && !wanted.has_extension()) {
    file = find_file(wanted.string() + ".yaml", {shipped});
  }
  if (file.empty()) throw config::Error("no launch file '" + wanted.string() + "'");
  return file;
}

Launch load_launch(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  Launch plain = read(path, {});
  if (overrides.empty()) return plain;
  std::vector<std::string> full;
  full.reserve(overrides.size());
  for (const std::string& assignment : overrides) full.push_back(in_full(plain, assignment));
  return read(path, full);
}

}  // namespace coop::launcher
