#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sweep/sweep_config.hpp"

namespace coop::sweep {

/// One array job: which runs, by what, and where.
struct ArrayJob {
  std::string name;
  std::vector<std::string> command;  ///< of a task; the number of its run is appended
  std::vector<int> runs;             ///< numbers; the place of one is its task's index
  std::optional<int> side_by_side;   ///< tasks at a time at most
  std::filesystem::path folder;      ///< of the tasks' logs
  std::filesystem::path working_folder;
};

/// What Slurm says of a job's tasks: state by index ("RUNNING"), and why a task waits, where one
/// does.
struct ArrayState {
  std::map<int, std::string> tasks;
  std::string reason;

  /// Tasks that wait, run, or are being ended.
  [[nodiscard]] int active() const;
  [[nodiscard]] int running() const;
};

/// For the job's name: the same for the same folder of results.
[[nodiscard]] std::string job_name(const std::filesystem::path& folder);

/// A word of a POSIX shell's command line, whatever it holds.
[[nodiscard]] std::string shell_word(std::string_view text);

/// The script that sbatch gets; each task of the array makes one run.
[[nodiscard]] std::string batch_script(const ArrayJob& job);

/// The arguments of sbatch, without the program's name. What the user wants comes first, so that it
/// cannot replace what the sweep needs.
[[nodiscard]] std::vector<std::string> sbatch_arguments(const ArrayJob& job,
                                                        const SweepConfig& config,
                                                        const std::filesystem::path& script);

/// The number of the job from what `sbatch --parsable` prints, warnings around it or not.
[[nodiscard]] std::optional<std::string> job_number(std::string_view printed);

/// squeue's arguments for one job, and what they print; lines of other form are left out.
[[nodiscard]] std::vector<std::string> squeue_arguments(const std::string& job);
[[nodiscard]] ArrayState array_state(std::string_view printed);

}  // namespace coop::sweep
