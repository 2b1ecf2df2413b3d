#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sweep/node/engine.hpp"
#include "sweep/node/job_watch.hpp"

namespace coop::sweep {

struct SlurmEngineOptions {
  std::vector<std::string> task;          ///< command that makes one run; its number is appended
  std::optional<int> side_by_side;        ///< tasks at a time at most; none: as the cluster likes
  std::chrono::milliseconds pause{5000};  ///< between two questions to squeue
};

/// The runs as tasks of an array job of the Slurm cluster that this machine belongs to. Folder of
/// the results, programs and sweep file lie on a file system that its nodes share.
///
/// A run whose task ended without a result of success is submitted again, `slurm.retries` times,
/// when the tasks beside it are through; then it gets a result that says so. Stopped, the job is
/// cancelled. A job that an earlier call left behind (killed, its machine gone) is cancelled first,
/// so that no two tasks make one run.
class SlurmEngine : public Engine {
 public:
  /// Throws std::runtime_error where Slurm's commands are not installed.
  explicit SlurmEngine(SlurmEngineOptions options);

  /// Throws std::runtime_error where the job is refused.
  void make(const Sweep& sweep, const std::vector<Run>& runs, const Watcher& watch) override;
  [[nodiscard]] std::string status() const override { return job_ ? job_->text() : ""; }

 private:
  void submit(const Sweep& sweep, const std::vector<Run>& runs);
  [[nodiscard]] bool wait_for(const Sweep& sweep, const std::vector<Run>& runs,
                              const Watcher& watch);
  /// Returns when its tasks are gone, or have not gone for a minute.
  void cancel(const std::string& number);
  void cancel_left_behind(const std::string& name);
  [[nodiscard]] std::vector<Run> to_make_again(const Sweep& sweep, const std::vector<Run>& runs);
  void give_up(const Sweep& sweep, const Run& run, std::size_t index) const;
  [[nodiscard]] std::string ask(const std::vector<std::string>& words) const;

  SlurmEngineOptions options_;
  std::filesystem::path sbatch_;
  std::filesystem::path squeue_;
  std::filesystem::path scancel_;
  std::filesystem::path folder_;  ///< of scripts and logs
  std::string number_;            ///< of the job that runs
  std::optional<JobWatch> job_;
  std::map<int, int> failures_;  ///< by the number of the run
};

}  // namespace coop::sweep
