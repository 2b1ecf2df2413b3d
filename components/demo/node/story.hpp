#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace coop::demo {

struct StoryOptions {
  std::filesystem::path folder;
  std::uint64_t seed = 1;
  int domain = 0;
  double rate = 2.0;  ///< of simulated time against real time
  std::vector<std::string> settings;
};

/// Survey, then collection, then the report. Exit code 0: all eggs collected, no collision; 1: not
/// so; 2: a part did not come to its end; 130: stopped by the user.
int run_story(const StoryOptions& options);

}  // namespace coop::demo
