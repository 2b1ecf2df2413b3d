#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "system/support/running_system.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {

inline constexpr std::chrono::minutes kSweepLimit{5};

/// A sweep of two whole systems, seconds of a mission each: nothing is tried, and every egg is
/// accounted for.
class TinySweep {
 public:
  explicit TinySweep(const std::string& launch = "config/launch/experiment.yaml") {
    control_folder();
    write_file_atomically(path("tiny.yaml"),
                          "title: tiny\n"
                          "launch: " +
                              launch +
                              "\n"
                              "seeds: 1\n"
                              "settings: [referee.time_limit=2]\n"
                              "grid: [{key: sequencer.mission.settle_time, values: [0.5, 0.6]}]\n"
                              "figures: [{name: hit, column: in_range, kind: share}]\n");
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return folder_.path() / name;
  }
  /// Starts it, with its results in `results`.
  [[nodiscard]] std::unique_ptr<Program> start(const std::filesystem::path& results,
                                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{path("tiny.yaml").string(), "-o", results.string(),
                                       "--domain", std::to_string(test_domain())};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("sweep", arguments, path("out"));
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace coop::test
