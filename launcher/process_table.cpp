#include "launcher/process_table.hpp"

#include <fcntl.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace coop::launcher {
namespace {

constexpr std::size_t kGulp = 65536;
/// Gulps taken from one who died: what the pipe can hold, however much was written.
constexpr int kLastGulps = 32;
constexpr int kPipeSize = 1 << 20;

}  // namespace

ProcessTable::ProcessTable(EventLoop& loop, std::filesystem::path log_folder, Echo echo)
    : loop_(loop), log_folder_(std::move(log_folder)), echo_(std::move(echo)) {}

ProcessTable::~ProcessTable() {
  for (auto& [name, entry] : entries_) {
    if (entry.pid != 0) {
      signal_group(entry.pid, SIGKILL);
      waitpid(entry.pid, nullptr, 0);
    }
    close_output(entry);
  }
}

Result<pid_t> ProcessTable::start(const PlannedComponent& component) {
  Entry& entry = entries_[component.name];
  close_output(entry);
  if (!entry.log) {
    entry.log = std::make_unique<LogFile>(log_folder_ / (component.name + ".log"),
                                          component.log.max_size, component.log.keep);
  }
  entry.echo = component.log.console;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return fail(std::string("pipe: ") + strerror(errno));
  entry.output.reset(ends[0]);
  const FileDescriptor output(ends[1]);
  fcntl(entry.output.get(), F_SETFL, O_NONBLOCK);
  // A larger pipe spares a talkative component waits; the kernel may refuse, then it has the usual
  // size.
  fcntl(output.get(), F_SETPIPE_SZ, kPipeSize);
  Result<pid_t> pid = start_process({.executable = component.executable,
                                     .arguments = component.arguments,
                                     .environment = component.environment,
                                     .folder = component.folder,
                                     .output = output.get()});
  if (!pid) {
    entry.output.reset();
    return pid;
  }
  entry.pid = *pid;
  loop_.watch(entry.output.get(), [this, name = component.name] {
    Entry& readable = entries_[name];
    read_output(name, readable);
  });
  return pid;
}

void ProcessTable::signal(pid_t pid, int number) {
  signal_group(pid, number);
}

std::string ProcessTable::last_words(const std::string& component) const {
  const auto found = entries_.find(component);
  return found == entries_.end() || !found->second.log ? "" : found->second.log->last_line();
}

bool ProcessTable::read_output(const std::string& name, Entry& entry) {
  std::array<char, kGulp> buffer;
  const ssize_t count = read(entry.output.get(), buffer.data(), buffer.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (count <= 0) {
    close_output(entry);
    return false;
  }
  const std::string_view data(buffer.data(), static_cast<std::size_t>(count));
  entry.log->append(data);
  if (entry.echo) echo_(name, data);
  return true;
}

void ProcessTable::close_output(Entry& entry) {
  if (entry.output.valid()) loop_.unwatch(entry.output.get());
  entry.output.reset();
}

std::vector<ProcessTable::Exit> ProcessTable::reap() {
  std::vector<Exit> exits;
  for (auto& [name, entry] : entries_) {
    if (entry.pid == 0) continue;
    int status = 0;
    if (waitpid(entry.pid, &status, WNOHANG) != entry.pid) continue;
    for (int i = 0; i < kLastGulps && entry.output.valid() && read_output(name, entry); ++i) {
    }
    exits.push_back({std::exchange(entry.pid, 0), ExitStatus::from_wait(status)});
  }
  return exits;
}

}  // namespace coop::launcher
