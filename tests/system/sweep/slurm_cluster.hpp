#pragma once
#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "system/support/running_system.hpp"

namespace coop::test {

/// A Slurm cluster whose only node is this machine: munged, slurmctld and slurmd of the test's own,
/// with key, sockets, ports and state apart from a cluster that this machine may belong to. Where
/// it is, SLURM_CONF of this process and what it starts names it.
class SlurmCluster {
 public:
  /// Why there can be none here; empty where there can.
  [[nodiscard]] static std::string obstacle();

  /// Returns when it takes jobs. Throws std::runtime_error with the ends of its logs.
  SlurmCluster();
  /// Stops it, and kills what that has left.
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  /// Cancels all jobs, waits for their ends, and stops the daemons.
  void stop();
  /// What squeue lists: tasks that wait, run, or are being ended.
  [[nodiscard]] std::string queue() const;
  /// Processes that belong to it: its own, and those of jobs.
  [[nodiscard]] std::vector<pid_t> processes() const;

 private:
  void write_configuration() const;
  void start(const std::string& program, const std::vector<std::string>& arguments);
  [[nodiscard]] std::string ask(const std::string& program,
                                const std::vector<std::string>& arguments) const;
  [[nodiscard]] std::string last_words() const;

  TemporaryFolder folder_;
  std::vector<std::unique_ptr<Program>> daemons_;  ///< stopped in reverse
};

}  // namespace coop::test
