#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace coop::runtime {

/// What every component executable takes on its command line; the launcher fills it in from the
/// launch file.
struct Options {
  std::string name;                   ///< of the component in the system; default: the executable's
  std::filesystem::path config;       ///< YAML of the component; empty: defaults
  std::vector<std::string> settings;  ///< key=value on top of the YAML
  int domain = 0;                     ///< DDS domain
  std::string robot;                  ///< robot name: DDS partition; empty: none, as ROS 2
  std::vector<std::string> dds;       ///< key=value, see DdsSettings
  bool sim_time = false;              ///< time comes from /clock
  bool lockstep = false;              ///< runs its ticks in step with all others
  std::vector<std::string> members;   ///< lockstep, the master: who must join before the first tick
  bool trace = false;                 ///< lockstep: hash of every sample written, into run_dir
  bool reliable_streams = false;      ///< sensor streams complete instead of fresh (log replay)
  std::uint64_t seed = 1;             ///< of all random streams
  std::filesystem::path log_dir;      ///< JSON-lines log; empty: console only
  std::filesystem::path run_dir = ".";  ///< journals and results of this run
  bool verbose = false;                 ///< log level debug

  enum class Mode { kRun, kCheck, kPrintConfig, kPrintTable };
  Mode mode = Mode::kRun;
};

/// Parses argv. Nothing where the text asked for (--help, --version) was printed, with the exit
/// code in `exit_code`; wrong usage prints one line to stderr and sets it to 2.
[[nodiscard]] std::optional<Options> parse_options(int argc, const char* const* argv,
                                                   const std::string& name,
                                                   const std::string& description, int& exit_code);

}  // namespace coop::runtime
