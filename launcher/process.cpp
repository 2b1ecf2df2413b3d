#include "launcher/process.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "launcher/file_descriptor.hpp"

extern char** environ;

namespace coop::launcher {
namespace {

std::vector<std::string> merged_environment(const std::vector<std::string>& changes) {
  const auto name_length = [](std::string_view entry) { return entry.find('='); };
  std::vector<std::string> merged;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view ours(*entry);
    bool replaced = false;
    for (const std::string& change : changes) {
      const std::size_t length = name_length(change);
      replaced |= length != std::string::npos && ours.starts_with(change.substr(0, length + 1));
    }
    if (!replaced) merged.emplace_back(ours);
  }
  merged.insert(merged.end(), changes.begin(), changes.end());
  return merged;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  out.reserve(texts.size() + 1);
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

struct Image {
  const char* path;
  char* const* argv;
  char* const* envp;
  const char* folder;
};

/// Between fork and exec in a process that may have had threads: only async-signal-safe calls, no
/// allocation.
[[noreturn]] void become(const Image& image, int input, int output, int failure, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (chdir(image.folder) == 0 && dup2(input, STDIN_FILENO) >= 0 &&
      dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0) {
    // Also what we have inherited or a library has opened. An old kernel refuses; ours are marked
    // anyway.
    close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
    execve(image.path, image.argv, image.envp);
  }
  const int reason = errno;
  [[maybe_unused]] const ssize_t written = write(failure, &reason, sizeof reason);
  _exit(127);
}

}  // namespace

ExitStatus ExitStatus::from_wait(int status) {
  if (WIFSIGNALED(status)) return {.code = 0, .signal = WTERMSIG(status)};
  return {.code = WEXITSTATUS(status), .signal = 0};
}

std::string ExitStatus::text() const {
  if (signal == 0) return "exit code " + std::to_string(code);
  const char* name = sigdescr_np(signal);
  return "killed by signal " + std::to_string(signal) +
         (name != nullptr ? " (" + std::string(name) + ")" : "");
}

Result<pid_t> start_process(const ProcessRequest& request) {
  std::string path = request.executable.string();
  const std::string folder = request.folder.string();
  std::vector<std::string> arguments = request.arguments;
  arguments.insert(arguments.begin(), path);
  std::vector<std::string> environment = merged_environment(request.environment);
  const std::vector<char*> argv = pointers(arguments);
  const std::vector<char*> envp = pointers(environment);

  FileDescriptor input(open("/dev/null", O_RDONLY | O_CLOEXEC));
  int ends[2];
  if (!input.valid() || pipe2(ends, O_CLOEXEC) != 0) return fail(std::string(strerror(errno)));
  FileDescriptor failure_read(ends[0]);
  FileDescriptor failure_write(ends[1]);

  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) return fail(std::string("fork: ") + strerror(errno));
  if (pid == 0) {
    const Image image{path.c_str(), argv.data(), envp.data(), folder.c_str()};
    become(image, input.get(), request.output, failure_write.get(), parent);
  }
  setpgid(pid, pid);  // in both processes, so that it holds whoever runs first
  failure_write.reset();
  int reason = 0;
  ssize_t count = 0;
  do {
    count = read(failure_read.get(), &reason, sizeof reason);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return pid;
  waitpid(pid, nullptr, 0);
  return fail("cannot execute " + path + ": " + strerror(reason));
}

void signal_group(pid_t pid, int number) {
  if (pid > 1) kill(-pid, number);
}

}  // namespace coop::launcher
