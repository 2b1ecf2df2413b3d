#include "demo/node/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <system_error>

extern char** environ;

namespace coop::demo {
namespace {

int to_exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::filesystem::path& output) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  const int error =
      ::posix_spawn(&pid_, command.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), "cannot start " + command.front());
  }
}

ChildProcess::~ChildProcess() {
  ask_to_stop();
  wait();
}

std::optional<int> ChildProcess::poll() {
  int status = 0;
  if (!exit_code_ && ::waitpid(pid_, &status, WNOHANG) == pid_) exit_code_ = to_exit_code(status);
  return exit_code_;
}

void ChildProcess::ask_to_stop() const {
  if (!exit_code_) ::kill(pid_, SIGTERM);
}

int ChildProcess::wait() {
  int status = 0;
  while (!exit_code_) {
    const pid_t ended = ::waitpid(pid_, &status, 0);
    if (ended == pid_) exit_code_ = to_exit_code(status);
    if (ended < 0 && errno != EINTR) exit_code_ = 127;
  }
  return *exit_code_;
}

}  // namespace coop::demo
