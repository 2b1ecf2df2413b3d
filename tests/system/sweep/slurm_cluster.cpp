#include "system/sweep/slurm_cluster.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "core/atomic_file.hpp"
#include "launcher/file_descriptor.hpp"

namespace coop::test {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kStart{60};
constexpr std::chrono::seconds kEnd{60};
constexpr std::array kNeeded{"/usr/sbin/munged", "/usr/sbin/slurmctld", "/usr/sbin/slurmd",
                             "/usr/bin/sbatch",  "/usr/bin/squeue",     "/usr/bin/scancel",
                             "/usr/bin/sinfo"};

std::string host() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) throw std::runtime_error("no host name");
  const std::string full = name.data();
  return full.substr(0, full.find('.'));
}

/// Two that nobody uses at the moment.
std::array<int, 2> free_ports() {
  std::array<int, 2> ports{};
  std::vector<launcher::FileDescriptor> open;
  for (int& port : ports) {
    open.emplace_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    socklen_t size = sizeof address;
    if (::bind(open.back().get(), any, size) != 0 ||
        ::getsockname(open.back().get(), any, &size) != 0) {
      throw std::runtime_error("no free port");
    }
    port = ntohs(address.sin_port);
  }
  return ports;
}

void write_key(const fs::path& file) {
  std::random_device random;
  std::string key;
  while (key.size() < 128) key += static_cast<char>(random() & 0xFFU);
  write_file_atomically(file, key);
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
}

std::string last_part(const fs::path& file) {
  constexpr std::size_t kShown = 800;
  const std::string text = read_file(file);
  return text.substr(text.size() - std::min(text.size(), kShown));
}

}  // namespace

std::string SlurmCluster::obstacle() {
  if (::geteuid() != 0) return "a cluster of the test's own needs root";
  for (const char* program : kNeeded) {
    if (!fs::exists(program)) return std::string("no ") + program + " (Debian: slurm-wlm, munge)";
  }
  return {};
}

SlurmCluster::SlurmCluster() {
  // Everybody may speak to munged; its socket lies in a folder that all may pass through.
  fs::permissions(folder_.path(), fs::perms(0711));
  for (const char* name : {"state", "spool", "munge"}) fs::create_directory(folder_.path() / name);
  write_configuration();
  const fs::path munge = folder_.path() / "munge";
  write_key(munge / "key");
  ::setenv("SLURM_CONF", (folder_.path() / "slurm.conf").c_str(), 1);
  start("munged",
        {"--foreground", "--num-threads=1", "--socket=" + (munge / "socket").string(),
         "--key-file=" + (munge / "key").string(), "--pid-file=" + (munge / "pid").string(),
         "--log-file=" + (munge / "log").string(), "--seed-file=" + (munge / "seed").string()});
  bool is_up = wait_until([&] { return fs::exists(munge / "socket"); });
  start("slurmctld", {"-D"});
  start("slurmd", {"-D"});
  is_up = is_up && wait_until(
                       [&] {
                         return ask("sinfo", {"--noheader", "--format=%T"}).starts_with("idle");
                       },
                       kStart);
  if (is_up) return;
  const std::string why = last_words();
  stop();
  ::unsetenv("SLURM_CONF");
  throw std::runtime_error("Slurm does not come up:" + why);
}

SlurmCluster::~SlurmCluster() {
  stop();
  for (const pid_t pid : processes()) ::kill(pid, SIGKILL);
  ::unsetenv("SLURM_CONF");
}

/// No control groups, accounting or user environments: what every container can do.
void SlurmCluster::write_configuration() const {
  const auto [control, node] = free_ports();
  const std::string folder = folder_.path().string();
  std::string text = fmt::format(
      "ClusterName=coop\n"
      "SlurmctldHost={0}(127.0.0.1)\n"
      "SlurmctldPort={1}\n"
      "SlurmdPort={2}\n"
      "NodeName={0} NodeAddr=127.0.0.1 CPUs={3} State=UNKNOWN\n"
      "PartitionName=all Nodes={0} Default=YES MaxTime=INFINITE State=UP\n",
      host(), control, node, std::max(1U, std::thread::hardware_concurrency()));
  text += fmt::format(
      "AuthType=auth/munge\n"
      "CredType=cred/munge\n"
      "AuthInfo=socket={0}/munge/socket\n"
      "StateSaveLocation={0}/state\n"
      "SlurmdSpoolDir={0}/spool\n"
      "SlurmctldPidFile={0}/slurmctld.pid\n"
      "SlurmdPidFile={0}/slurmd.pid\n",
      folder);
  text +=
      "SlurmUser=root\n"
      "SlurmdUser=root\n"
      "ProctrackType=proctrack/linuxproc\n"
      "TaskPlugin=task/none\n"
      "JobAcctGatherType=jobacct_gather/none\n"
      "SelectType=select/cons_tres\n"
      "SelectTypeParameters=CR_CPU\n"
      "MpiDefault=none\n"
      "SwitchType=switch/none\n"
      "PropagateResourceLimits=NONE\n"
      "ReturnToService=2\n"
      "KillWait=5\n"
      "SchedulerParameters=sched_min_interval=100000,batch_sched_delay=0\n";
  write_file_atomically(folder_.path() / "slurm.conf", text);
}

void SlurmCluster::start(const std::string& program, const std::vector<std::string>& arguments) {
  daemons_.push_back(std::make_unique<Program>("/usr/sbin/" + program, arguments,
                                               folder_.path() / (program + ".out")));
}

std::string SlurmCluster::ask(const std::string& program,
                              const std::vector<std::string>& arguments) const {
  Program question("/usr/bin/" + program, arguments, folder_.path() / (program + ".out"));
  question.wait(kEnd);
  return question.output();
}

std::string SlurmCluster::queue() const {
  return ask("squeue", {"--noheader", "--array"});
}

std::vector<pid_t> SlurmCluster::processes() const {
  const std::string mark = "SLURM_CONF=" + folder_.path().string();
  std::vector<pid_t> pids;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    pid_t pid = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (error != std::errc{} || *end != '\0' || !is_alive(pid)) continue;
    std::ifstream file(entry.path() / "environ");
    std::ostringstream environment;
    environment << file.rdbuf();
    if (environment.str().find(mark) != std::string::npos) pids.push_back(pid);
  }
  return pids;
}

std::string SlurmCluster::last_words() const {
  std::string text;
  for (const char* name : {"munged.out", "slurmctld.out", "slurmd.out"}) {
    const fs::path file = folder_.path() / name;
    if (fs::exists(file)) text += std::string("\n") + name + ":\n" + last_part(file);
  }
  return text;
}

void SlurmCluster::stop() {
  if (daemons_.size() > 1) {
    (void)ask("scancel", {"--user=root"});
    (void)wait_until([&] { return queue().empty(); }, kEnd);
  }
  while (!daemons_.empty()) {
    daemons_.back()->signal(SIGTERM);
    (void)daemons_.back()->wait(kEnd);
    daemons_.pop_back();
  }
}

}  // namespace coop::test
