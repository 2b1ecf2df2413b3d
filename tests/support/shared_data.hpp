#pragma once
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace coop::test {

/// A file of the shared data set (recorded logs, maps), or nothing where the set is absent. It is
/// looked for in the folder that the environment variable COOP_SHARED names, else in ../shared/data
/// beside the checkout.
inline std::optional<std::filesystem::path> shared_data(const std::string& name) {
  const char* root = std::getenv("COOP_SHARED");
  const std::filesystem::path folder =
      root ? std::filesystem::path(root) : std::filesystem::path(COOP_SOURCE_DIR) / "../shared";
  std::filesystem::path path = folder / "data" / name;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  return path;
}

}  // namespace coop::test
