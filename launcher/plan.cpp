#include "launcher/plan.hpp"

#include <unistd.h>

#include <algorithm>
#include <optional>

#include "core/name.hpp"

namespace coop::launcher {
namespace {

using Named = config::Named<Component>;

void check_name(const std::string& name, const std::string& where) {
  if (is_name(name)) return;
  throw config::Error(where + ": '" + name +
                      "' is no name: expected letters, digits, '_' and '-', 64 at most");
}

const Named* find_component(const Launch& launch, const std::string& name) {
  const auto found = std::ranges::find(launch.components, name, &Named::name);
  return found == launch.components.end() ? nullptr : &*found;
}

void check_after(const Launch& launch, const Named& component) {
  for (const std::string& name : component.value.after) {
    if (find_component(launch, name) != nullptr) continue;
    std::vector<std::string> names;
    for (const Named& other : launch.components) names.push_back(other.name);
    const std::string_view near = config::nearest_name(name, names);
    throw config::Error(component.value.after_where + ": " + component.name +
                        ": after: no component '" + name + "'" +
                        (near.empty() ? "" : "; did you mean '" + std::string(near) + "'?"));
  }
}

/// One master of time, whom all others follow.
void check_lockstep(const Launch& launch) {
  if (!launch.lockstep) return;
  const std::string where = launch.file.string() + ": lockstep: ";
  if (!launch.use_sim_time) throw config::Error(where + "expected use_sim_time: true with it");
  const auto masters = std::ranges::count_if(launch.components, [](const Named& component) {
    return component.value.enabled && component.value.time == "system";
  });
  if (masters != 1) {
    throw config::Error(where + "expected one component with `time: system`, found " +
                        std::to_string(masters));
  }
}

/// Depth-first, in the order of declaration, what a component waits for first.
class StartOrder {
 public:
  explicit StartOrder(const Launch& launch) : launch_(launch) {
    for (const Named& component : launch.components) visit(component);
  }

  std::vector<const Named*> order;

 private:
  void visit(const Named& component) {
    if (std::ranges::find(order, &component) != order.end()) return;
    const auto open = std::ranges::find(path_, &component);
    if (open != path_.end()) {
      std::string circle;
      for (auto it = open; it != path_.end(); ++it) circle += (*it)->name + " -> ";
      throw config::Error(component.value.after_where +
                          ": after: components wait for each other: " + circle + component.name);
    }
    path_.push_back(&component);
    for (const std::string& name : component.value.after) visit(*find_component(launch_, name));
    path_.pop_back();
    order.push_back(&component);
  }

  const Launch& launch_;
  std::vector<const Named*> path_;
};

Variables make_variables(const Launch& launch, const Places& places,
                         const std::filesystem::path& run_folder) {
  Variables variables;
  const auto set_text = [&variables](const std::string& name, const std::string& text) {
    variables.set(name, text, text);
  };
  set_text("share", places.share.string());
  set_text("run_dir", run_folder.string());
  set_text("robot", launch.robot);
  set_text("domain", std::to_string(launch.domain));
  set_text("seed", std::to_string(launch.seed));
  for (const auto& variable : launch.variables) {
    const std::string where = variable.where + ": variables." + variable.key;
    variables.set(variable.key, variables.replace(variable.text, where),
                  variables.replace_in_yaml(variable, where));
  }
  return variables;
}

std::string in_full(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().string();
}

class Planner {
 public:
  Planner(const Launch& launch, const Places& places, const std::filesystem::path& run_folder)
      : launch_(launch),
        places_(places),
        run_folder_(run_folder),
        variables_(make_variables(launch, places, run_folder)),
        folders_{launch.file.parent_path(), places.share} {}

  /// With variables replaced and the keys' folder in full (relative: to where the launcher runs).
  [[nodiscard]] runtime::DdsSettings dds() const {
    const std::string where = launch_.dds_where + ": dds";
    runtime::DdsSettings settings = launch_.dds;
    for (auto* texts : {&settings.peers, &settings.interfaces}) {
      for (std::string& text : *texts) text = variables_.replace(text, where);
    }
    settings.server = variables_.replace(settings.server, where);
    if (!settings.keys.empty()) settings.keys = variables_.replace(settings.keys.string(), where);
    return checked(std::move(settings), launch_.dds_where);
  }

  [[nodiscard]] PlannedComponent resolve(const Named& component) const {
    const Component& declared = component.value;
    PlannedComponent planned;
    planned.name = component.name;
    planned.where = component.where;
    planned.executable = executable_of(component);
    planned.folder = std::filesystem::absolute(places_.share);
    planned.restart = declared.restart;
    planned.log = declared.log;
    planned.sends_heartbeat = declared.health == "heartbeat";
    planned.start_timeout = declared.start_timeout;
    planned.heartbeat_timeout = declared.heartbeat_timeout;
    planned.stop_timeout = declared.stop_timeout;
    planned.exit_ends_system = declared.on_exit == "shutdown";
    planned.required = declared.required;
    for (const auto& variable : declared.environment) {
      const std::string where = variable.where + ": " + component.name + ": environment";
      planned.environment.push_back(variable.key + "=" + variables_.replace(variable.text, where));
    }
    if (!launch_.dds.profiles.empty()) {
      const auto file = file_of(launch_.dds.profiles, launch_.file.string() + ": dds.profiles");
      planned.environment.push_back("FASTRTPS_DEFAULT_PROFILES_FILE=" + in_full(file));
    }
    for (const auto& parameter : declared.parameters) {
      const std::string where = parameter.where + ": " + component.name + ": " + parameter.key;
      config::Assignment replaced = parameter;
      replaced.value = variables_.replace_in_yaml(parameter, where);
      planned.parameters.push_back(std::move(replaced));
    }
    planned.arguments = arguments_of(component, planned);
    return planned;
  }

 private:
  static runtime::DdsSettings checked(runtime::DdsSettings settings, const std::string& where) {
    if (!settings.keys.empty()) settings.keys = in_full(settings.keys);
    try {
      settings.validate();
    } catch (const config::Error& problem) {
      throw config::Error(where + ": " + problem.what());
    }
    return settings;
  }

  [[nodiscard]] runtime::DdsSettings dds_of(const Named& component) const {
    runtime::DdsSettings settings = dds();
    std::vector<std::string> overrides;
    for (const auto& override : component.value.dds) {
      const std::string where = override.where + ": " + component.name + ": dds";
      overrides.push_back(override.key + "=" + variables_.replace_in_yaml(override, where));
    }
    const std::string origin = component.value.dds_where + ": " + component.name + ": dds";
    runtime::apply_dds_settings(settings, overrides, origin);
    return checked(std::move(settings), component.value.dds_where);
  }

  [[nodiscard]] std::filesystem::path file_of(const std::string& name,
                                              const std::string& where) const {
    const std::filesystem::path wanted = variables_.replace(name, where);
    auto file = find_file(wanted, folders_);
    if (file.empty()) throw config::Error(where + ": no file '" + wanted.string() + "'");
    return file;
  }

  [[nodiscard]] std::filesystem::path executable_of(const Named& component) const {
    const std::string where = component.where + ": " + component.name + ": executable";
    const std::string& declared = component.value.executable;
    const std::filesystem::path name =
        declared.empty() ? component.name : variables_.replace(declared, where);
    const bool is_path = name.string().find('/') != std::string::npos;
    auto file = find_file(name, is_path ? folders_ : std::vector{places_.programs});
    if (file.empty() || access(file.c_str(), X_OK) != 0) {
      throw config::Error(where + ": no program '" + name.string() + "'" +
                          (is_path ? "" : " in " + places_.programs.string()));
    }
    return std::filesystem::absolute(file);
  }

  [[nodiscard]] std::string config_of(const Named& component,
                                      const std::filesystem::path& executable) const {
    const std::string& declared = component.value.config;
    if (!declared.empty()) {
      return in_full(file_of(declared, component.where + ": " + component.name + ": config"));
    }
    const std::filesystem::path usual =
        std::filesystem::path("config") / (executable.filename().string() + ".yaml");
    const auto file = find_file(usual, {places_.share});
    return file.empty() ? std::string() : in_full(file);
  }

  [[nodiscard]] std::vector<std::string> arguments_of(const Named& component,
                                                      const PlannedComponent& planned) const {
    std::vector<std::string> arguments;
    if (planned.sends_heartbeat) {
      arguments = {"--name",    component.name,
                   "--robot",   launch_.robot,
                   "--domain",  std::to_string(launch_.domain),
                   "--seed",    std::to_string(launch_.seed),
                   "--run-dir", run_folder_.string(),
                   "--log-dir", (run_folder_ / "logs").string()};
      if (launch_.use_sim_time && !is_master(component)) arguments.emplace_back("--sim-time");
      if (launch_.lockstep) add_lockstep(component, arguments);
      for (const std::string& setting : dds_of(component).assignments()) {
        arguments.insert(arguments.end(), {"--dds", setting});
      }
      if (launch_.reliable_streams) arguments.emplace_back("--reliable-streams");
      const std::string config = config_of(component, planned.executable);
      if (!config.empty()) arguments.insert(arguments.end(), {"--config", config});
      for (const auto& parameter : planned.parameters) {
        arguments.insert(arguments.end(), {"--set", parameter.key + "=" + parameter.value});
      }
    }
    for (const std::string& argument : component.value.arguments) {
      arguments.push_back(
          variables_.replace(argument, component.where + ": " + component.name + ": arguments"));
    }
    return arguments;
  }

  static bool is_master(const Named& component) { return component.value.time == "system"; }

  void add_lockstep(const Named& component, std::vector<std::string>& arguments) const {
    arguments.emplace_back("--lockstep");
    if (launch_.trace) arguments.emplace_back("--trace");
    if (!is_master(component)) return;
    for (const Named& other : launch_.components) {
      const bool takes_part = other.value.enabled && other.value.health == "heartbeat";
      if (!takes_part || is_master(other)) continue;
      arguments.insert(arguments.end(), {"--member", other.name});
    }
  }

  const Launch& launch_;
  const Places& places_;
  const std::filesystem::path& run_folder_;
  Variables variables_;
  std::vector<std::filesystem::path> folders_;
};

}  // namespace

Plan make_plan(const Launch& launch, const Places& places,
               const std::filesystem::path& run_folder) {
  if (!launch.robot.empty()) check_name(launch.robot, launch.file.string() + ": robot");
  check_lockstep(launch);
  for (const Named& component : launch.components) {
    check_name(component.name, component.where + ": components");
    check_after(launch, component);
  }
  const StartOrder start(launch);
  const Planner planner(launch, places, run_folder);
  Plan plan{.robot = launch.robot, .domain = launch.domain, .dds = planner.dds(), .components = {}};
  for (const Named* component : start.order) {
    if (!component->value.enabled) continue;
    PlannedComponent planned = planner.resolve(*component);
    for (std::size_t i = 0; i < plan.components.size(); ++i) {
      const auto& after = component->value.after;
      if (std::ranges::find(after, plan.components[i].name) != after.end())
        planned.after.push_back(i);
    }
    plan.components.push_back(std::move(planned));
  }
  if (plan.components.empty()) {
    throw config::Error(launch.file.string() + ": components: nothing to start");
  }
  return plan;
}

}  // namespace coop::launcher
