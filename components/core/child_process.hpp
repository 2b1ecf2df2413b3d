#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace coop {

/// A program started by this one, its output in a file; asked to stop (SIGTERM) and waited for when
/// this object goes. It has a process group of its own, so that a terminal's Ctrl-C reaches it only
/// through us, and is asked to stop by the kernel when we are killed.
class ChildProcess {
 public:
  /// Throws std::system_error where it cannot be started. Call it from the main thread: the kernel
  /// ties the child's life to the thread that made it.
  ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& output);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Exit code (128 + signal where it was killed) once it has ended.
  [[nodiscard]] std::optional<int> poll();
  void ask_to_stop() const;
  void kill_group() const;
  /// Waits for the end.
  int wait();

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
};

}  // namespace coop
