#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace coop::sweep {

struct ProgramOptions {
  std::string file;              ///< sweep file, or the name of one that comes with Coop
  std::filesystem::path folder;  ///< of the results
  int jobs = 1;
  int domain = 60;  ///< the first
  std::string engine = "local";
  std::optional<int> seeds;  ///< instead of the file's
  std::optional<std::int64_t> first_seed;
  std::vector<std::string> settings;  ///< after the file's
  std::vector<int> only;              ///< numbers of runs: make these, no report; empty: all
};

/// Makes what is missing of the sweep, then the report. Exit code 0: all runs have a result; 1:
/// some have none; 130: stopped by the user.
int run_sweep(const ProgramOptions& options);

}  // namespace coop::sweep
