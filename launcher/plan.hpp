#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/places.hpp"
#include "launcher/launch_file.hpp"

namespace coop::launcher {

/// One process, with everything found and replaced: ready to be started.
struct PlannedComponent {
  std::string name;
  std::string where;  ///< file:line of its declaration
  std::filesystem::path executable;
  std::filesystem::path folder =
      ".";  ///< it runs in the share folder: names of Coop's own files are relative to it
  std::vector<std::string> arguments;
  std::vector<std::string> environment;  ///< NAME=value, on top of the launcher's own
  std::vector<std::size_t> after;        ///< places in Plan::components, all smaller than its own
  std::vector<config::Assignment> parameters;
  RestartPolicy restart;
  LogSettings log;
  bool sends_heartbeat = true;
  double start_timeout = 0.0;      ///< s
  double heartbeat_timeout = 0.0;  ///< s
  double stop_timeout = 0.0;       ///< s
  bool exit_ends_system = false;
  bool required = true;
};

/// What is started, in this order.
struct Plan {
  std::string robot;
  int domain = 0;
  runtime::DdsSettings dds;  ///< of the launcher itself, and of components that do not deviate
  std::vector<PlannedComponent> components;
};

/// Replaces ${name}. Known: share, run_dir, robot, domain, seed and the launch file's variables.
/// Throws config::Error starting with `where` for one that is not known.
class Variables {
 public:
  /// `in_yaml`: the same value as YAML, so that 1 stays a number and "1" a text.
  void set(std::string name, std::string text, std::string in_yaml);
  /// In a text.
  [[nodiscard]] std::string replace(std::string_view text, const std::string& where) const;
  /// In a value in YAML. One that is nothing but a variable takes the variable's kind: with `rate:
  /// 1`, "${rate}" is a number.
  [[nodiscard]] std::string replace_in_yaml(const config::Assignment& value,
                                            const std::string& where) const;

 private:
  struct Variable {
    std::string name;
    std::string text;
    std::string in_yaml;
  };
  [[nodiscard]] const Variable& find(std::string_view name, const std::string& where) const;
  std::vector<Variable> variables_;
};

/// Checks what can be checked without starting anything: executables and files exist, `after` names
/// components, nothing waits for itself. Order: as declared, but what comes `after` another one
/// follows it. Throws config::Error.
[[nodiscard]] Plan make_plan(const Launch& launch, const Places& places,
                             const std::filesystem::path& run_folder);

}  // namespace coop::launcher
