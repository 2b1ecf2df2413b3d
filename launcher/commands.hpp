#pragma once
#include <optional>
#include <string>

namespace coop::launcher {

/// Which running system a command is for; without either: the only one.
struct SystemChoice {
  std::optional<int> domain;
  std::optional<std::string> robot;
};

/// The commands given from another terminal. Each prints its result, or one line on stderr, and
/// answers the exit code.
int show_processes(const SystemChoice& choice, bool as_json);
/// `verb` is restart, stop or start; waits until it is done.
int control_component(const SystemChoice& choice, const std::string& verb, const std::string& name);
int take_down(const SystemChoice& choice);
/// The last `lines` lines (0: all) of what a component has printed, of the running system or else
/// of the latest run in `run_dir`; `follow`: and what comes.
int show_log(const SystemChoice& choice, const std::string& name, const std::string& run_dir,
             std::size_t lines, bool follow);

}  // namespace coop::launcher
