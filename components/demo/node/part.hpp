#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "demo/node/observer.hpp"
#include "demo/record.hpp"

namespace coop::demo {

/// One part of the demo: a system brought up by the launcher and watched until its mission ends.
struct Part {
  std::string title;
  std::string launch_file;
  std::vector<std::string> settings;
  std::filesystem::path folder;    ///< of this part's run
  std::filesystem::path programs;  ///< folder of the executables
  int domain = 0;
  std::uint64_t seed = 1;
  double timeout = 240.0;  ///< s of wall time
  Watch watch;
};

struct PartResult {
  Record record;
  int exit_code = 0;     ///< of the launcher, 0 when the mission ended and all stopped in order
  bool stopped = false;  ///< by SIGINT or SIGTERM
  std::filesystem::path output;
};

/// Shows progress on standard output while it runs: one line that changes on a terminal, a line a
/// change elsewhere.
[[nodiscard]] PartResult run_part(const Part& part);

/// Says why a part did not come to its end, and the exit code for that; 0 where it did.
[[nodiscard]] int complain(const Part& part, const PartResult& result);

}  // namespace coop::demo
