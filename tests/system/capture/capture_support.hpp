#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"
#include "system/support/running_system.hpp"

namespace coop::test {

/// A launch file of this test.
class LaunchText {
 public:
  explicit LaunchText(const std::string& text) { write_file_atomically(path(), text); }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "test.yaml"; }

 private:
  TemporaryFolder folder_;
};

/// The captures of a run, by name.
inline std::vector<std::filesystem::path> captures_of(const std::filesystem::path& run_folder) {
  std::vector<std::filesystem::path> files;
  const auto folder = run_folder / "captures";
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".mcap") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// A simulated robot that drives nowhere: enough topics, little work.
inline const std::string kSmallSystem =
    "use_sim_time: true\n"
    "defaults: {restart: {policy: always}}\n"
    "components:\n"
    "  record: {parameters: {chunk_age: 0.5}}\n"
    "  simulator:\n"
    "    after: [record]\n"
    "    time: system\n"
    "    parameters: {world: maps/duck_house.world.yaml, journal: \"\"}\n"
    "  lidar_driver: {after: [simulator]}\n"
    "  amcl:\n"
    "    after: [simulator]\n"
    "    parameters: {map_file: maps/duck_house_survey.yaml}\n";

}  // namespace coop::test
