#include "launcher/component_check.hpp"

#include <fcntl.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <list>
#include <thread>

#include "launcher/event_loop.hpp"
#include "launcher/process.hpp"

namespace coop::launcher {
namespace {

constexpr std::chrono::seconds kTimeout{20};
constexpr std::size_t kMaxOutput = 65536;

struct RunningCheck {
  const PlannedComponent* component;
  pid_t pid;
  FileDescriptor output;
  Instant deadline;
  std::string said;
  bool over = false;
};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// The place of the parameter the message speaks of, else of the component.
std::string place_of(const PlannedComponent& component, const std::string& message) {
  for (const auto& parameter : component.parameters) {
    if (message.find("'" + parameter.key + "'") != std::string::npos ||
        message.find(" " + parameter.key + ":") != std::string::npos) {
      return parameter.where;
    }
  }
  return component.where;
}

Result<RunningCheck> begin_check(const PlannedComponent& component) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return fail(std::string("pipe: ") + strerror(errno));
  FileDescriptor read_end(ends[0]);
  const FileDescriptor write_end(ends[1]);
  fcntl(read_end.get(), F_SETFL, O_NONBLOCK);
  std::vector<std::string> arguments = component.arguments;
  arguments.emplace_back("--check");
  const auto pid = start_process({.executable = component.executable,
                                  .arguments = std::move(arguments),
                                  .environment = component.environment,
                                  .folder = component.folder,
                                  .output = write_end.get()});
  if (!pid) return fail(pid.error());
  return RunningCheck{.component = &component,
                      .pid = *pid,
                      .output = std::move(read_end),
                      .deadline = std::chrono::steady_clock::now() + kTimeout,
                      .said = {},
                      .over = false};
}

void read_answer(RunningCheck& check) {
  char buffer[4096];
  const ssize_t count = read(check.output.get(), buffer, sizeof buffer);
  if (count > 0 && check.said.size() < kMaxOutput)
    check.said.append(buffer, static_cast<std::size_t>(count));
  check.over = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
}

/// Empty where the component is content.
std::string end_check(const RunningCheck& check) {
  const bool late = !check.over;
  if (late) signal_group(check.pid, SIGKILL);
  int raw = 0;
  waitpid(check.pid, &raw, 0);
  const ExitStatus status = ExitStatus::from_wait(raw);
  if (!late && status.clean()) return {};
  std::string message = first_line(check.said);
  if (late) message = "no answer to --check within " + std::to_string(kTimeout.count()) + " s";
  if (message.empty()) message = "--check: " + status.text();
  const std::string& name = check.component->name;
  const std::string prefix = message.starts_with(name + ": ") ? "" : name + ": ";
  return place_of(*check.component, message) + ": " + prefix + message;
}

}  // namespace

std::vector<std::string> check_components(const Plan& plan) {
  const std::size_t at_once = std::max(2U, std::thread::hardware_concurrency());
  std::vector<std::string> refusals;
  std::list<RunningCheck> running;
  EventLoop loop;
  auto next = plan.components.begin();
  while (next != plan.components.end() || !running.empty()) {
    while (next != plan.components.end() && running.size() < at_once) {
      const PlannedComponent& component = *next++;
      if (!component.sends_heartbeat) continue;
      auto check = begin_check(component);
      if (!check) {
        refusals.push_back(component.where + ": " + component.name + ": " + check.error());
        continue;
      }
      running.push_back(std::move(*check));
      loop.watch(running.back().output.get(), [&check = running.back()] { read_answer(check); });
    }
    if (running.empty()) continue;
    loop.run_once(running.front().deadline);
    for (auto it = running.begin(); it != running.end();) {
      if (!it->over && std::chrono::steady_clock::now() < it->deadline) {
        ++it;
        continue;
      }
      loop.unwatch(it->output.get());
      if (std::string refusal = end_check(*it); !refusal.empty())
        refusals.push_back(std::move(refusal));
      it = running.erase(it);
    }
  }
  return refusals;
}

}  // namespace coop::launcher
