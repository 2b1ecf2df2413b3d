#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/supervisor.hpp"

namespace coop::launcher {

/// The robot's components run already on this domain; one line.
class InUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct UpOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;
  std::string until;              ///< empty, "ready" or "mission-done"
  std::optional<double> timeout;  ///< s
  bool quiet = false;
};

/// Brings the system of a launch file up and stays with it until it ends. Throws config::Error
/// where the launch is bad, before anything was started.
[[nodiscard]] Outcome run_system(const UpOptions& options);

/// Everything run_system() checks before it starts something. Throws config::Error.
void check_system(const UpOptions& options);

/// The launch file as a Compose file, or the override of that name. Throws config::Error.
[[nodiscard]] std::string compose_system(const UpOptions& options,
                                         const std::string& override_name);

}  // namespace coop::launcher
