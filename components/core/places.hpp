#pragma once
#include <filesystem>
#include <vector>

namespace coop {

/// Where the parts of Coop lie: in a checkout, or installed (PREFIX/lib/coop and
/// PREFIX/share/coop).
struct Places {
  std::filesystem::path programs;  ///< folder of the executables
  std::filesystem::path share;     ///< folder that holds config/ and maps/

  /// From where the running program lies. COOP_HOME in the environment names another share folder.
  /// Throws config::Error when no config/ can be found.
  static Places of_this_program();
};

/// First existing file of `name` itself (absolute) or below one of `folders`; empty where there is
/// none.
[[nodiscard]] std::filesystem::path find_file(const std::filesystem::path& name,
                                              const std::vector<std::filesystem::path>& folders);

}  // namespace coop
