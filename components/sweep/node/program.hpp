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
  std::optional<int> jobs;       ///< side by side; none: 1 here, as many as it likes a cluster
  int domain = 60;               ///< the first that runs may take
  std::string engine = "local";  ///< or slurm
  bool restart = false;          ///< all runs are made anew
  std::optional<std::string> partition;  ///< of Slurm, instead of the file's, as the next two
  std::optional<std::string> time_limit;
  std::optional<int> retries;
  std::string slurm_options;  ///< words for sbatch, after the file's
  std::optional<int> seeds;   ///< instead of the file's
  std::optional<std::int64_t> first_seed;
  std::vector<std::string> settings;  ///< after the file's
  std::vector<int> only;              ///< numbers of runs: make these, no report; empty: all
};

/// Makes what is missing of the sweep, then the report. Exit code 0: all runs have a result; 1:
/// some have none; 130: stopped by the user.
int run_sweep(const ProgramOptions& options);

}  // namespace coop::sweep
