#include "launcher/compose.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace coop::launcher {
namespace {

/// Where a container sees its keys.
constexpr const char* kKeys = "/etc/coop/keys";

/// A text in double quotes is one in YAML as in JSON; Compose wants a dollar sign twice.
std::string quoted(const std::string& text) {
  std::string doubled;
  for (const char c : text) doubled.append(c == '$' ? 2 : 1, c);
  return nlohmann::json(doubled).dump();
}

void replace_all(std::string& text, const std::string& old, const std::string& now) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size())) {
    text.replace(at, old.size(), now);
  }
}

/// What stands here in the image's words.
class Relocation {
 public:
  explicit Relocation(const Places& places) {
    // Programs first: in a checkout they lie below the share folder.
    add(places.programs, image_.programs);
    add(places.share, image_.share);
  }

  [[nodiscard]] std::string text(std::string original) const {
    for (const auto& [here, there] : moves_) replace_all(original, here, there);
    return original;
  }

  /// Of a file that must be in the image.
  [[nodiscard]] std::string file(const std::filesystem::path& original,
                                 const std::string& where) const {
    std::string moved = text(original.lexically_normal().string());
    if (!moved.starts_with(image_.programs.string() + "/") &&
        !moved.starts_with(image_.share.string() + "/")) {
      throw config::Error(where + ": " + original.string() +
                          " is not in the image; give its parameters in the launch file");
    }
    return moved;
  }

 private:
  void add(const std::filesystem::path& here, const std::filesystem::path& there) {
    const auto full = std::filesystem::absolute(here).lexically_normal();
    moves_.emplace_back(full.string() + "/", there.string() + "/");
  }

  ImagePlaces image_;
  std::vector<std::pair<std::string, std::string>> moves_;
};

/// Arguments as the container gets them: without the folder of log files, as the engine keeps what
/// a component prints.
std::vector<std::string> arguments_in_image(const PlannedComponent& component,
                                            const Relocation& relocation) {
  std::vector<std::string> arguments;
  for (std::size_t i = 0; i < component.arguments.size(); ++i) {
    const std::string& argument = component.arguments[i];
    if (component.sends_heartbeat && argument == "--log-dir") {
      ++i;
    } else if (i > 0 && component.sends_heartbeat && component.arguments[i - 1] == "--config") {
      arguments.push_back(relocation.file(argument, component.where + ": " + component.name));
    } else if (i > 0 && component.arguments[i - 1] == "--dds" && argument.starts_with("keys=")) {
      arguments.push_back(std::string("keys=") + kKeys);
    } else {
      arguments.push_back(relocation.text(argument));
    }
  }
  return arguments;
}

const char* restart_of(const PlannedComponent& component) {
  if (component.restart.policy == "always") return "unless-stopped";
  return component.restart.policy == "never" ? "\"no\"" : "on-failure";
}

std::string seconds(double value) {
  return std::to_string(static_cast<long>(std::ceil(value))) + "s";
}

void add_health(std::string& out, const PlannedComponent& component, const ImagePlaces& image) {
  if (!component.sends_heartbeat) return;
  out += "    healthcheck:\n      <<: *health\n      test: [CMD, " +
         (image.programs / "health").string() + ", " + component.name +
         "]\n      start_period: " + seconds(component.start_timeout) + "\n";
}

/// The order of starts and stops, without waiting for health: a probe comes after an interval, so
/// each link of a chain would cost one, and components wait for their inputs themselves.
void add_dependencies(std::string& out, const Plan& plan, const PlannedComponent& component) {
  if (component.after.empty()) return;
  out += "    depends_on:\n";
  for (const std::size_t place : component.after) {
    out += "      " + plan.components[place].name + ": {condition: service_started}\n";
  }
}

std::string service(const Plan& plan, const PlannedComponent& component,
                    const Relocation& relocation) {
  const ImagePlaces image;
  std::string out = "  " + component.name + ":\n    <<: *component\n    command: [";
  out += relocation.file(component.executable, component.where);
  for (const std::string& argument : arguments_in_image(component, relocation)) {
    out += argument.starts_with("--") ? ",\n      " : ", ";  // an option and its value on one line
    out += quoted(argument);
  }
  out += "]\n";
  if (!component.environment.empty()) {
    out += "    environment:\n";
    for (const std::string& variable : component.environment) {
      out += "      - " + quoted(relocation.text(variable)) + "\n";
    }
  }
  add_health(out, component, image);
  out += std::string("    restart: ") + restart_of(component) + "\n";
  out += "    stop_grace_period: " + seconds(component.stop_timeout) + "\n";
  add_dependencies(out, plan, component);
  return out;
}

std::string heading(const std::string& title) {
  return "# Made by `coop compose " + title + "` from that launch file: change it, not this one.\n";
}

/// What all services have in common. Every probe is a process in the container, started through
/// engine and runtime: hence no more often than needed for a quick start.
constexpr const char* kCommon = R"(x-component: &component
  image: "${COOP_IMAGE:-coop:latest}"
  init: true
  read_only: true
  tmpfs:
    - /run/coop:uid=10001,gid=10001,mode=0700,size=1m
    - /tmp:mode=1777,size=64m
  volumes:
    - runs:/var/lib/coop
  cap_drop: [ALL]
  security_opt: ["no-new-privileges:true"]
  logging:
    driver: json-file
    options: {max-size: 10m, max-file: "3"}
x-health: &health
  interval: "${COOP_HEALTH_INTERVAL:-2s}"
  timeout: 5s
  retries: 2
services:
)";

/// One line or more for each service; services without any are left out.
template <class Lines>
std::string override_of(const Plan& plan, const Lines& lines) {
  std::string out = "services:\n";
  for (const PlannedComponent& component : plan.components) {
    const std::string text = lines(component);
    if (!text.empty()) out += "  " + component.name + ":\n" + text;
  }
  return out;
}

std::string host_override(const Plan& plan) {
  return "# On the host's network, with its shared memory: several systems on one host need\n"
         "# different domains. One user for all, or shared memory stays silent.\n" +
         override_of(plan, [](const PlannedComponent&) {
           return std::string(
               "    network_mode: host\n    ipc: host\n    user: \"10001:10001\"\n"
               "    environment:\n      COOP_DDS: \"transport=shm ${COOP_DDS:-}\"\n");
         });
}

std::string security_override(const Plan& plan) {
  return "# Each component sees its own keys alone, of the folder that `coop keys make` has made:\n"
         "# COOP_KEYS=... in the environment, readable by user 10001.\n" +
         override_of(plan, [](const PlannedComponent& component) {
           const std::string keys = kKeys;
           std::string out = "    environment:\n      COOP_DDS: \"security=true keys=" + keys +
                             " ${COOP_DDS:-}\"\n    volumes:\n";
           for (const std::string& name : {std::string("public"), component.name}) {
             out.append("      - \"${COOP_KEYS:-./keys}/").append(name).append(":").append(keys);
             out.append("/").append(name).append(":ro\"\n");
           }
           return out;
         });
}

std::string hardware_override(const Plan& plan) {
  const auto lines = [](const PlannedComponent& component) -> std::string {
    static constexpr std::pair<const char*, const char*> kDevices[] = {
        {"chassis_driver", "chassis"},
        {"lidar_driver", "lidar"},
        {"arm_driver", "arm"},
        {"camera_driver", "camera"}};
    const auto program = component.executable.filename().string();
    const auto found = std::ranges::find(kDevices, program,
                                         [](const auto& pair) { return std::string(pair.first); });
    if (found == std::end(kDevices)) return "";
    std::string variable = found->second;
    std::ranges::transform(variable, variable.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    // /dev/null stands for a device that is not there: the file is read, the driver says so.
    return "    devices:\n      - \"${COOP_" + variable + "_DEVICE:-/dev/null}:/dev/" +
           found->second + "\"\n    group_add: [\"${COOP_DEVICE_GROUP:-20}\"]\n";
  };
  return "# Devices of the host for the drivers, named by COOP_LIDAR_DEVICE=/dev/ttyUSB0 and so "
         "on;\n"
         "# their group is dialout (20 in Debian).\n" +
         override_of(plan, lines);
}

}  // namespace

std::string compose_file(const Plan& plan, const Places& places, const std::string& title) {
  const Relocation relocation(places);
  std::string out = heading(title) +
                    "# docker-compose up -d; docker-compose down forgets nothing, down -v also\n"
                    "# journals and maps.\n" +
                    kCommon;
  for (const PlannedComponent& component : plan.components) {
    out += service(plan, component, relocation);
  }
  return out + "volumes:\n  runs:\n";
}

std::string compose_override(const Plan& plan, const std::string& name, const std::string& title) {
  const std::string head = heading(title + " --override " + name);
  if (name == "host") return head + host_override(plan);
  if (name == "security") return head + security_override(plan);
  if (name == "hardware") return head + hardware_override(plan);
  throw config::Error("override: expected host, security or hardware, got '" + name + "'");
}

}  // namespace coop::launcher
