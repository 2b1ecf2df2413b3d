#pragma once
#include <filesystem>
#include <fstream>
#include <string>

namespace coop::test {

/// A component of a launch file that plays the part of `name` (small_part.cpp) under the program's
/// name of that part, which permissions go by.
inline std::string small_component(const std::filesystem::path& folder, const std::string& name) {
  const auto program = folder / "parts" / name;
  std::filesystem::create_directories(program.parent_path());
  if (!std::filesystem::exists(program)) {
    std::filesystem::create_symlink(COOP_SMALL_PART, program);
  }
  // Not the configuration that comes with the program of that name.
  const auto config = folder / "parts" / "small.yaml";
  std::ofstream(config) << "{}\n";
  return "  " + name + ": {executable: \"" + program.string() + "\", config: \"" + config.string() +
         "\"}\n";
}

}  // namespace coop::test
