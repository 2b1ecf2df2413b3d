#include "system/support/running_system.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "system/support/test_domain.hpp"

namespace coop::test {
namespace {

constexpr int kPollMs = 10;

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

std::filesystem::path program_path(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  return std::filesystem::path(COOP_BIN_DIR) / name;
}

}  // namespace

const std::filesystem::path& control_folder() {
  static const TemporaryFolder folder;
  static const bool is_set = setenv("COOP_RUNTIME_DIR", folder.path().c_str(), 1) == 0;
  if (!is_set) throw std::runtime_error("cannot set COOP_RUNTIME_DIR");
  return folder.path();
}

bool wait_until(const std::function<bool()>& condition, milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    poll(nullptr, 0, kPollMs);
  }
  return true;
}

bool is_alive(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return false;
  const std::size_t end = line.rfind(')');
  return end != std::string::npos && end + 2 < line.size() && line[end + 2] != 'Z' &&
         line[end + 2] != 'X';
}

Program::Program(const std::string& name, const std::vector<std::string>& arguments,
                 const std::filesystem::path& output)
    : output_(output) {
  const launcher::FileDescriptor file(
      open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644));
  const auto pid = launcher::start_process({.executable = program_path(name),
                                            .arguments = arguments,
                                            .environment = {},
                                            .folder = ".",
                                            .output = file.get()});
  if (!pid) throw std::runtime_error(pid.error());
  pid_ = *pid;
}

Program::~Program() {
  if (status_) return;
  launcher::signal_group(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void Program::signal(int number) const {
  kill(pid_, number);
}

std::optional<launcher::ExitStatus> Program::wait(milliseconds limit) {
  if (status_) return status_;
  wait_until(
      [this] {
        int raw = 0;
        if (waitpid(pid_, &raw, WNOHANG) == pid_) status_ = launcher::ExitStatus::from_wait(raw);
        return status_.has_value();
      },
      limit);
  return status_;
}

std::string Program::output() const {
  return read_text(output_);
}

RunningSystem::RunningSystem(const std::filesystem::path& launch_file,
                             const std::vector<std::string>& arguments, int domain)
    : domain_(domain) {
  (void)control_folder();
  std::vector<std::string> all{"up",        launch_file.string(),
                               "--domain",  std::to_string(domain_),
                               "--run-dir", (folder_.path() / "runs").string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  launcher_.emplace("launcher", all, folder_.path() / "launcher.out");
}

std::optional<launcher::SystemView> RunningSystem::view() {
  auto client = launcher::ControlClient::connect(domain_, std::nullopt);
  if (!client) return std::nullopt;
  auto reply = client->ask({.verb = "ps", .name = {}});
  if (!reply) return std::nullopt;
  run_folder_ = reply->system.run_folder;
  return std::move(reply->system);
}

std::optional<launcher::Row> RunningSystem::row(const std::string& component) {
  const auto system = view();
  if (!system) return std::nullopt;
  const auto found = std::ranges::find(system->rows, component, &launcher::Row::name);
  if (found == system->rows.end()) return std::nullopt;
  return *found;
}

bool RunningSystem::wait_for(const std::function<bool(const launcher::SystemView&)>& condition,
                             milliseconds limit) {
  bool holds = false;
  wait_until(
      [&] {
        const bool ended = launcher_->wait(milliseconds(0)).has_value();
        const auto system = view();
        holds = system && condition(*system);
        return holds || ended;
      },
      limit);
  return holds;
}

bool RunningSystem::wait_for_state(const std::string& component, const std::string& state,
                                   milliseconds limit) {
  return wait_for(
      [&](const launcher::SystemView& system) {
        return std::ranges::any_of(system.rows, [&](const launcher::Row& row) {
          return row.name == component && row.state == state;
        });
      },
      limit);
}

bool RunningSystem::wait_until_ready(milliseconds limit) {
  return wait_for(
      [](const launcher::SystemView& system) {
        return std::ranges::all_of(system.rows,
                                   [](const launcher::Row& row) { return row.state == "ready"; });
      },
      limit);
}

pid_t RunningSystem::kill_component(const std::string& component) {
  const auto found = row(component);
  if (!found || found->pid == 0) throw std::runtime_error(component + " does not run");
  kill(found->pid, SIGKILL);
  return found->pid;
}

std::optional<launcher::ExitStatus> RunningSystem::stop() {
  launcher_->signal(SIGTERM);
  return launcher_->wait();
}

RunningSystem::Result RunningSystem::command(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--domain", std::to_string(domain_)});
  return run_launcher(arguments, folder_.path());
}

std::vector<pid_t> RunningSystem::pids() {
  std::vector<pid_t> out;
  if (const auto system = view()) {
    for (const auto& row : system->rows) {
      if (row.pid != 0) out.push_back(row.pid);
    }
  }
  return out;
}

std::filesystem::path RunningSystem::run_folder() {
  if (run_folder_.empty()) (void)view();
  return run_folder_;
}

RunningSystem::Result run_launcher(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder) {
  (void)control_folder();
  Program program("launcher", arguments, folder / "command.out");
  const auto status = program.wait();
  return {status && status->signal == 0 ? status->code : -1, program.output()};
}

}  // namespace coop::test
