#include "system/containers/composition.hpp"

#include <poll.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

namespace coop::test {
namespace {

constexpr int kAskPeriodMs = 200;

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace

Composition::Composition(std::string project, std::vector<std::filesystem::path> files)
    : project_(std::move(project)), files_(std::move(files)) {}

Composition::~Composition() {
  try {
    compose({"down", "--volumes", "--timeout", "2"});
  } catch (const std::exception&) {
    // The engine's own end takes what is left along.
  }
}

std::string Composition::compose(const std::vector<std::string>& arguments,
                                 milliseconds limit) const {
  std::vector<std::string> all{"--project-name", project_};
  for (const auto& file : files_) all.insert(all.end(), {"--file", file.string()});
  all.insert(all.end(), arguments.begin(), arguments.end());
  return need_tool("docker-compose", all, limit);
}

std::vector<std::string> Composition::services() const {
  std::istringstream lines(compose({"config", "--services"}));
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) names.push_back(line);
  return names;
}

std::string Composition::container(const std::string& service) const {
  const Answer answer =
      run_tool("docker", {"ps", "--all", "--quiet", "--filter",
                          "label=com.docker.compose.project=" + project_, "--filter",
                          "label=com.docker.compose.service=" + service});
  return answer.code == 0 ? one_line(answer.output) : "";
}

std::string Composition::inspect(const std::string& service, const std::string& format) const {
  const std::string id = container(service);
  if (id.empty()) return "";
  const Answer answer = run_tool("docker", {"inspect", "--format", format, id});
  return answer.code == 0 ? one_line(answer.output) : "";
}

std::map<std::string, std::string> Composition::states() const {
  const Answer answer =
      run_tool("docker", {"ps", "--all", "--filter", "label=com.docker.compose.project=" + project_,
                          "--format", "{{.Label \"com.docker.compose.service\"}} {{.Status}}"});
  std::map<std::string, std::string> states;
  if (answer.code != 0) return states;
  std::istringstream lines(answer.output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    if (space != std::string::npos) states[line.substr(0, space)] = line.substr(space + 1);
  }
  return states;
}

bool Composition::wait_until_healthy(const std::vector<std::string>& services,
                                     milliseconds limit) const {
  return wait_until(
      [&] {
        // Asking costs the engine a good part of a processor.
        poll(nullptr, 0, kAskPeriodMs);
        auto now = states();
        return std::ranges::all_of(services, [&](const auto& name) {
          return now[name].find("(healthy)") != std::string::npos;
        });
      },
      limit);
}

bool Composition::kill_program(const std::string& service) const {
  const std::string init = inspect(service, "{{.State.Pid}}");
  if (init.empty() || init == "0") return false;
  std::ifstream children("/proc/" + init + "/task/" + init + "/children");
  pid_t program = 0;
  children >> program;
  return program > 1 && kill(program, SIGKILL) == 0;
}

int Composition::restarts(const std::string& service) const {
  const std::string count = inspect(service, "{{.RestartCount}}");
  return count.empty() ? -1 : std::stoi(count);
}

void Composition::docker(const std::string& verb, const std::string& service) const {
  need_tool("docker", {verb, container(service)});
}

std::string Composition::logs() const {
  return compose({"logs", "--no-color", "--tail", "15"});
}

}  // namespace coop::test
