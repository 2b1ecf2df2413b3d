#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace coop::launcher {

/// How a process ended.
struct ExitStatus {
  int code = 0;    ///< exit code, where it was not killed
  int signal = 0;  ///< 0: ended by itself

  [[nodiscard]] static ExitStatus from_wait(int status);
  [[nodiscard]] bool clean() const { return code == 0 && signal == 0; }
  /// "exit code 3", "killed by signal 11 (Segmentation fault)"
  [[nodiscard]] std::string text() const;
};

struct ProcessRequest {
  std::filesystem::path executable;
  std::vector<std::string> arguments;    ///< without the program's name
  std::vector<std::string> environment;  ///< NAME=value, replacing or extending our own
  std::filesystem::path folder = ".";    ///< working directory
  int output = -1;                       ///< becomes stdout and stderr; stays open here
};

/// Starts a process in a process group of its own that dies when we die, with no input, default
/// signal handling and no file of ours open. Must be called from the main thread (the kernel ties
/// the process's life to the calling thread). The error says why it could not be executed.
[[nodiscard]] Result<pid_t> start_process(const ProcessRequest& request);

/// To the process group of `pid`; nothing happens where it is gone.
void signal_group(pid_t pid, int number);

}  // namespace coop::launcher
