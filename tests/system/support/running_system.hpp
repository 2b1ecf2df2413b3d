#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "launcher/control_client.hpp"
#include "launcher/process.hpp"
#include "support/temporary_folder.hpp"
#include "system/support/test_domain.hpp"

namespace coop::test {

using std::chrono::milliseconds;

/// Upper limits for conditions that are waited for, generous because machines are busy; nothing is
/// timed by them.
inline constexpr milliseconds kSoon{20000};

/// Calls `condition` until it holds; false when `limit` has passed.
bool wait_until(const std::function<bool()>& condition, milliseconds limit = kSoon);

/// The same, with `watch.look()` before each look at the condition: for one that listens over DDS.
template <class Watch>
bool look_until(Watch& watch, const std::function<bool()>& condition, milliseconds limit) {
  return wait_until(
      [&] {
        watch.look();
        return condition();
      },
      limit);
}

/// Control sockets of this test process lie in a folder of its own, away from systems a person
/// runs: sets COOP_RUNTIME_DIR for it and what it starts.
const std::filesystem::path& control_folder();

/// Whether a process (no zombie) of this id lives.
[[nodiscard]] bool is_alive(pid_t pid);

/// A program of the build, or any other, with its output in files.
class Program {
 public:
  /// `name` without a slash: from the build's bin folder.
  Program(const std::string& name, const std::vector<std::string>& arguments,
          const std::filesystem::path& output);
  ~Program();  ///< kills it
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Nothing when it has not ended within `limit`.
  std::optional<launcher::ExitStatus> wait(milliseconds limit = kSoon);
  /// What it has printed so far, stdout and stderr.
  [[nodiscard]] std::string output() const;

 private:
  std::filesystem::path output_;
  pid_t pid_ = 0;
  std::optional<launcher::ExitStatus> status_;
};

/// A system under `launcher up`, on a domain, in a run folder and with a control socket of its own.
/// Ends, whatever happens, with the object.
class RunningSystem {
 public:
  explicit RunningSystem(const std::filesystem::path& launch_file,
                         const std::vector<std::string>& arguments = {},
                         int domain = test_domain());

  [[nodiscard]] Program& launcher() { return *launcher_; }
  /// Nothing while the launcher does not answer (yet, or any more).
  [[nodiscard]] std::optional<launcher::SystemView> view();
  [[nodiscard]] std::optional<launcher::Row> row(const std::string& component);
  /// False as well when the launcher ends before the condition holds.
  bool wait_for(const std::function<bool(const launcher::SystemView&)>& condition,
                milliseconds limit = kSoon);
  bool wait_for_state(const std::string& component, const std::string& state,
                      milliseconds limit = kSoon);
  /// All components ready.
  bool wait_until_ready(milliseconds limit = kSoon);
  /// Sends SIGKILL to the component's process; answers its pid.
  pid_t kill_component(const std::string& component);
  /// SIGTERM to the launcher, and wait.
  std::optional<launcher::ExitStatus> stop();
  /// Runs `launcher ARGUMENTS --domain D` to its end; its output and exit code.
  struct Result {
    int code = -1;
    std::string output;
  };
  Result command(std::vector<std::string> arguments);
  [[nodiscard]] std::vector<pid_t> pids();
  [[nodiscard]] std::filesystem::path run_folder();
  [[nodiscard]] int domain() const { return domain_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  int domain_;
  std::filesystem::path run_folder_;
  std::optional<Program> launcher_;
};

/// Runs `launcher ARGUMENTS` to its end on this process's domain.
RunningSystem::Result run_launcher(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder);

}  // namespace coop::test
