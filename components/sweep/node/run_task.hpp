#pragma once
#include <chrono>
#include <filesystem>
#include <optional>

#include "core/child_process.hpp"
#include "sweep/node/engine.hpp"

namespace coop::sweep {

/// One run: a system brought up by the launcher in a DDS domain of its own, until it ends by
/// itself. The unit of work of every engine.
class RunTask {
 public:
  /// Starts it. What an earlier try left is removed. Throws std::system_error.
  RunTask(const Sweep& sweep, const Run& run, int domain);

  /// True once the run is over and its result is written.
  bool poll();
  /// Stops it, without a result.
  void stop();

 private:
  void conclude(int exit_code);

  const Sweep& sweep_;
  Run run_;
  std::filesystem::path folder_;
  std::chrono::steady_clock::time_point begun_;
  bool out_of_time_ = false;
  std::optional<ChildProcess> launcher_;
};

}  // namespace coop::sweep
