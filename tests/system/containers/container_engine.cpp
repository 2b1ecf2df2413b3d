#include "system/containers/container_engine.hpp"

#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <stdexcept>

#include "core/atomic_file.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kStart{60};
constexpr const char* kBridge = "/sys/class/net/docker0";
constexpr std::chrono::minutes kBase{8};

std::string last_part(const std::string& text) {
  constexpr std::size_t kShown = 2000;
  return text.substr(text.size() - std::min(text.size(), kShown));
}

/// An engine, not only a client.
bool engine_answers() {
  const Answer answer = run_tool("docker", {"version", "--format", "{{.Server.Version}}"});
  return answer.code == 0;
}

/// Off at first, dockerd would set the whole machine's policy for forwarded packets to DROP.
bool allow_forwarding() {
  const fs::path file = "/proc/sys/net/ipv4/ip_forward";
  std::ofstream(file) << "1";
  std::string value;
  std::ifstream(file) >> value;
  return value == "1";
}

}  // namespace

std::string find_tool(const std::string& name) {
  for (const char* folder : {"/usr/bin/", "/usr/sbin/", "/usr/local/bin/"}) {
    const std::string path = folder + name;
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return "";
}

Answer run_tool(const std::string& program, const std::vector<std::string>& arguments,
                milliseconds limit) {
  const TemporaryFolder folder;
  const std::string path = find_tool(program.substr(program.rfind('/') + 1));
  const std::string file = program.find('/') != std::string::npos ? program : path;
  if (file.empty()) return {127, "no program " + program};
  Program running(file, arguments, folder.path() / "output");
  const auto status = running.wait(limit);
  if (!status) return {-1, running.output() + "\nnot done in time"};
  return {status->signal != 0 ? 128 + status->signal : status->code, running.output()};
}

std::string need_tool(const std::string& program, const std::vector<std::string>& arguments,
                      milliseconds limit) {
  Answer answer = run_tool(program, arguments, limit);
  if (answer.code == 0) return std::move(answer.output);
  std::string line = program;
  for (const std::string& argument : arguments) line += " " + argument;
  throw std::runtime_error(line + ": exit code " + std::to_string(answer.code) + "\n" +
                           last_part(answer.output));
}

std::string ContainerEngine::obstacle() {
  for (const char* tool : {"docker", "docker-compose"}) {
    if (find_tool(tool).empty())
      return std::string("no ") + tool + " (Debian: docker.io, docker-compose)";
  }
  if (geteuid() != 0) return "killing programs in containers needs root";
  if (engine_answers()) return "";
  for (const char* tool : {"dockerd", "containerd", "mmdebstrap", "iptables"}) {
    if (find_tool(tool).empty())
      return std::string("no container engine runs, and no ") + tool + " to start one";
  }
  if (!allow_forwarding()) return "no container engine runs, and this machine forwards no packets";
  return "";
}

ContainerEngine::ContainerEngine() {
  // The legacy builder is the one that every engine has.
  setenv("DOCKER_BUILDKIT", "0", 1);
  if (engine_answers()) return;
  had_bridge_ = fs::exists(kBridge);
  start();
}

void ContainerEngine::start() {
  const std::string socket = "unix://" + (folder() / "docker.sock").string();
  daemon_ = std::make_unique<Program>(
      find_tool("dockerd"),
      std::vector<std::string>{"--data-root", folder() / "data", "--exec-root", folder() / "exec",
                               "--pidfile", folder() / "pid", "--host", socket},
      folder() / "log");
  setenv("DOCKER_HOST", socket.c_str(), 1);
  const bool is_up =
      wait_until([this] { return engine_answers() || !is_alive(daemon_->pid()); }, kStart);
  if (is_up && is_alive(daemon_->pid())) return;
  const std::string log = last_part(daemon_->output());
  daemon_.reset();
  throw std::runtime_error("dockerd does not start:\n" + log);
}

ContainerEngine::~ContainerEngine() {
  if (!daemon_) return;
  daemon_->signal(SIGTERM);
  daemon_->wait(std::chrono::seconds(60));
  daemon_.reset();
  umount2((folder() / "exec" / "netns" / "default").c_str(), MNT_DETACH);
  unsetenv("DOCKER_HOST");
  // An address more or less changes what DDS takes for the host.
  if (!had_bridge_) (void)run_tool("ip", {"link", "delete", "docker0"});
}

void ContainerEngine::need_base_image(const fs::path& cache, const std::string& packages) const {
  if (run_tool("docker", {"image", "inspect", kBaseImage}).code == 0) return;
  if (!fs::exists(cache)) {
    fs::create_directories(cache.parent_path());
    const fs::path draft = cache.string() + ".new.tar";
    std::vector<std::string> arguments{"--quiet", "--variant=minbase"};
    if (!packages.empty()) arguments.push_back("--include=" + packages);
    arguments.insert(arguments.end(),
                     {"bookworm", draft.string(), "/etc/apt/sources.list.d/debian.sources"});
    need_tool("mmdebstrap", arguments, kBase);
    fs::rename(draft, cache);
  }
  need_tool("docker", {"import", "--change", "CMD [\"bash\"]", cache.string(), kBaseImage}, kBase);
}

}  // namespace coop::test
