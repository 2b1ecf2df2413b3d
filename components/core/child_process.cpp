#include "core/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace coop {
namespace {

int to_exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

[[noreturn]] void throw_errno(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// In the child, between fork and exec: only async-signal-safe calls. Its errno goes through
/// `failure`, which exec closes.
[[noreturn]] void become(char* const* arguments, int input, int output, int failure, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (::dup2(input, 0) >= 0 && ::dup2(output, 1) >= 0 && ::dup2(output, 2) >= 0) {
    ::execv(arguments[0], arguments);
  }
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = ::write(failure, &reason, sizeof reason);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::filesystem::path& output) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int out = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  int ends[2] = {-1, -1};
  const auto close_all = [&] {
    for (const int file : {input, out, ends[0], ends[1]}) {
      if (file >= 0) ::close(file);
    }
  };
  const pid_t parent = ::getpid();
  if (input < 0 || out < 0 || ::pipe2(ends, O_CLOEXEC) != 0 || (pid_ = ::fork()) < 0) {
    const int reason = errno;
    close_all();
    throw std::system_error(reason, std::generic_category(), "cannot start " + command.front());
  }
  if (pid_ == 0) become(arguments.data(), input, out, ends[1], parent);
  ::setpgid(pid_, pid_);  // in both processes, so that it holds whoever runs first
  ::close(ends[1]);
  ends[1] = -1;
  int reason = 0;
  ssize_t count = 0;
  do {
    count = ::read(ends[0], &reason, sizeof reason);
  } while (count < 0 && errno == EINTR);
  close_all();
  if (count <= 0) return;
  ::waitpid(pid_, nullptr, 0);
  errno = reason;
  throw_errno("cannot start " + command.front());
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

void ChildProcess::kill_group() const {
  if (!exit_code_) ::kill(-pid_, SIGKILL);
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

}  // namespace coop
